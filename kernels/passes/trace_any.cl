// trace_any: whether each ray of a list is blocked, for the ray benchmark and its checks.
// Reads: scene, rays [n][2]. Writes: hits [n], diag. Domain: n rays. Atomics: diag only. Next:
// nothing.
#include "passes/trace_list.h"

__kernel void trace_any(SCENE_PARAMS DIAG_PARAMS __global const F4* rays, __global F4* hits,
                        const uint n) {
  uint i = (uint)get_global_id(0);
  if (i >= n) return;
  SCENE_FROM_PARAMS
  hits[i] = trace_listed(&scene_data, rays, i, 1);
}

// trace_closest: the closest hit of each ray of a list, for the ray benchmark and its checks.
// Reads: scene, rays [n][2]. Writes: hits [n], diag. Domain: n rays. Atomics: diag only. Next:
// nothing.
#include "passes/trace_list.h"

__kernel void trace_closest(SCENE_PARAMS DIAG_PARAMS __global const F4* rays, __global F4* hits,
                            const uint n) {
  uint i = (uint)get_global_id(0);
  if (i >= n) return;
  SCENE_FROM_PARAMS
  hits[i] = trace_listed(&scene_data, rays, i, 0);
}

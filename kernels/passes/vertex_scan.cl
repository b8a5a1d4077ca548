// vertex_scan: from the number of vertices of each sub-path to the place of its first one among
// all. Reads and writes: light_first [paths of the launch + 1], eye_first [pixels of the slice +
// 1]. Domain: two work-groups, one for each side. Atomics: none. Next: vertex_order.
#include "passes/bundles.h"
#include "shared/limits.h"

__kernel void vertex_scan(LIGHT_VERTEX_PARAMS EYE_VERTEX_PARAMS const Launch launch) {
  __local uint ends[VERTEX_SCAN_GROUP];
  int light = get_group_id(0) == 0;
  __global uint* first = light ? light_first : eye_first;
  uint n = light ? launch.path_count : launch.slice_count;
  if (get_group_id(0) > 1) n = 0u;
  uint lane = (uint)get_local_id(0), lanes = (uint)get_local_size(0);
  uint share = (n + lanes - 1u) / lanes;
  uint begin = min(lane * share, n), end = min(begin + share, n);
  uint sum = 0u;
  for (uint i = begin; i < end; ++i) sum += first[i];
  ends[lane] = sum;
  barrier(CLK_LOCAL_MEM_FENCE);
  uint before = 0u;
  for (uint i = 0u; i < lane; ++i) before += ends[i];
  for (uint i = begin; i < end; ++i) {
    uint count = first[i];
    first[i] = before;
    before += count;
  }
  if (get_group_id(0) <= 1 && lane == lanes - 1u) first[n] = before;
}

// vertex_scan: from the number of vertices of each sub-path to the place of its first one among
// all. Reads and writes: light_first [paths of the launch + 1], eye_first [pixels of the slice +
// 1]. Domain: two work-groups, one for each side. Atomics: none. Next: vertex_order.
#include "passes/bundles.h"
#include "passes/scan.h"

__kernel void vertex_scan(LIGHT_VERTEX_PARAMS EYE_VERTEX_PARAMS const Launch launch) {
  __local uint ends[SCAN_GROUP];
  int light = get_group_id(0) == 0;
  __global uint* first = light ? light_first : eye_first;
  uint n = light ? launch.path_count : launch.slice_count;
  if (get_group_id(0) > 1) n = 0u;
  uint total = scan_exclusive(first, n, ends);
  if (get_group_id(0) <= 1 && get_local_id(0) == get_local_size(0) - 1) first[n] = total;
}

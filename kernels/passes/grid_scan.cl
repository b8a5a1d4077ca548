// grid_scan: from the counts of digits to where each block puts its first photon of each.
// Reads and writes: grid_digits [SORT_DIGITS][SORT_BLOCKS]. Domain: one work-group. Atomics: none.
// Next: grid_scatter.
#include "passes/bundles.h"
#include "passes/scan.h"

__kernel void grid_scan(GRID_PARAMS const Launch launch) {
  __local uint ends[SCAN_GROUP];
  uint n = get_group_id(0) == 0 ? SORT_DIGITS * SORT_BLOCKS : 0u;
  scan_exclusive(grid_digits, n, ends);
}

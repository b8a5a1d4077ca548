// grid_scatter: a stable sort of the photons by one digit of their cell.
// Reads: grid_pairs or grid_sorted, grid_digits. Writes: the other of the two. Domain: SORT_BLOCKS
// blocks. Atomics: none. Next: grid_count of the next digit, or grid_ranges.
#include "passes/sort_block.h"

__kernel void grid_scatter(GRID_PARAMS const Launch launch) {
  uint block = (uint)get_global_id(0);
  if (block >= SORT_BLOCKS) return;
  int odd = (launch.digit & 1u) != 0u;
  __global const uint* from = odd ? grid_sorted : grid_pairs;
  __global uint* to = odd ? grid_pairs : grid_sorted;
  uint end = sort_block_begin(launch, block + 1u);
  for (uint i = sort_block_begin(launch, block); i < end; ++i) {
    uint key = from[2 * (size_t)i];
    uint place = grid_digits[sort_place(sort_digit(launch, key), block)]++;
    to[2 * (size_t)place] = key;
    to[2 * (size_t)place + 1u] = from[2 * (size_t)i + 1u];
  }
}

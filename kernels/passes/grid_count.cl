// grid_count: how often each digit occurs in each block of photons.
// Reads: grid_pairs, or grid_sorted for odd digits. Writes: grid_digits. Domain: SORT_BLOCKS
// blocks. Atomics: none. Next: grid_scan.
#include "passes/sort_block.h"

__kernel void grid_count(GRID_PARAMS const Launch launch) {
  uint block = (uint)get_global_id(0);
  if (block >= SORT_BLOCKS) return;
  __global const uint* from = launch.digit & 1u ? grid_sorted : grid_pairs;
  uint end = sort_block_begin(launch, block + 1u);
  for (uint d = 0u; d < SORT_DIGITS; ++d) grid_digits[sort_place(d, block)] = 0u;
  for (uint i = sort_block_begin(launch, block); i < end; ++i)
    ++grid_digits[sort_place(sort_digit(launch, from[2 * (size_t)i]), block)];
}

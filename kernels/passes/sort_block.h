// Blocks and digits of the photon sort: each digit reads one of two lists and writes the other.
#ifndef PELLUCID_PASSES_SORT_BLOCK_H
#define PELLUCID_PASSES_SORT_BLOCK_H

#include "passes/bundles.h"
#include "shared/limits.h"

INLINE uint sort_block_begin(Launch launch, uint block) {
  uint share = (launch.photon_count + SORT_BLOCKS - 1u) / SORT_BLOCKS;
  return min(block * share, launch.photon_count);
}
INLINE uint sort_digit(Launch launch, uint key) {
  return (key >> (launch.digit * SORT_DIGIT_BITS)) & (SORT_DIGITS - 1u);
}
/// Place of a block's count of a digit: blocks of one digit stand together, so that their sums in
/// this order are where each block puts what it has of it.
INLINE uint sort_place(uint digit, uint block) {
  return digit * SORT_BLOCKS + block;
}

#endif

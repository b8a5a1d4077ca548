// Owen-scrambled Sobol points, four dimensions padded to any number [Burley20]: every path,
// block of dimensions and block of SOBOL_BLOCK iterations has its own scrambles, so that these are
// independent of each other and iterations within a block fill their strata together.
//
// In a block of 16 points every coordinate has one point per 1/16. A nested uniform scramble
// [Owen95] then is a scramble of the upper 4 bits, and 28 bits below them that are independent from
// point to point: no hash stands in for its tree, it is exact.
#ifndef PELLUCID_CORE_SOBOL_H
#define PELLUCID_CORE_SOBOL_H

#include "core/random.h"
#include "shared/limits.h"

#if SOBOL_BLOCK != 16
#error "points are kept as nibbles: a block has 16 iterations"
#endif

/// Marks hashes that scramble a block, so that they share nothing with those of its iterations.
#define DIM_SCRAMBLE 0x80000000u

/// Column k of the generator matrices, one nibble per coordinate (x lowest): Sobol dimensions 2, 1,
/// 3, 4 by the direction numbers of [JoeKuo08]. In this order the neighbours xy, yz and zw are
/// (0,4,2)-nets: one point in every elementary interval of area 1/16.
#define SOBOL_COLUMN_0 0x8888u
#define SOBOL_COLUMN_1 0xcc4cu
#define SOBOL_COLUMN_2 0x262au
#define SOBOL_COLUMN_3 0x591fu

/// Point `index` < 16 of the unscrambled sequence, as nibbles.
INLINE uint sobol_nibbles(uint index) {
  uint p = (0u - (index & 1u)) & SOBOL_COLUMN_0;
  p ^= (0u - ((index >> 1) & 1u)) & SOBOL_COLUMN_1;
  p ^= (0u - ((index >> 2) & 1u)) & SOBOL_COLUMN_2;
  return p ^ ((0u - ((index >> 3) & 1u)) & SOBOL_COLUMN_3);
}

/// Owen's scramble of an index < 16: a bit is flipped or not as `flips` says at the node of the
/// bits above it (bit 1 is the root, node n has children 2n and 2n + 1). Aligned runs of 2, 4 or 8
/// iterations stay aligned runs of the sequence, and so are nets themselves.
INLINE uint owen_index(uint index, uint flips) {
  uint flip = ((flips >> 1) & 1u) << 3;
  flip |= ((flips >> (2u + (index >> 3))) & 1u) << 2;
  flip |= ((flips >> (4u + (index >> 2))) & 1u) << 1;
  return index ^ (flip | ((flips >> (8u + (index >> 1))) & 1u));
}

/// The same for four nibbles at once. A bit's flip is any boolean function of the bits above it,
/// here as a polynomial over GF(2) with random coefficients: those of 1 and b3 in the halves of
/// c.x, of b2 and b2 b3 in c.w, of b1 and b1 b3 in c.y, of b1 b2 and b1 b2 b3 in c.z. The upper
/// half of the result is rubbish.
INLINE uint owen_nibbles(uint v, U4 c) {
  uint b3 = ((v >> 3) & 0x1111u) * 7u;  // a set bit selects the bits below it
  uint b2 = ((v >> 2) & 0x1111u) * 3u;
  uint b1 = (v >> 1) & 0x1111u;
  uint by_b1 = c.y ^ (b3 & (c.y >> 16)) ^ (b2 & (c.z ^ (b3 & (c.z >> 16))));
  uint by_b2 = c.w ^ (b3 & (c.w >> 16));
  return v ^ c.x ^ (b3 & (c.x >> 16)) ^ (b2 & by_b2) ^ (b1 & by_b1);
}

/// Four words of (path, iteration, dimension, seed), each uniform in [0, 2^32).
INLINE U4 sobol_words(Rng rng, uint dimension) {
  Rng block = rng;
  block.iteration = rng.iteration / SOBOL_BLOCK;
  U4 c = random_words(block, dimension | DIM_SCRAMBLE);
  U4 below = random_words(rng, dimension);
  // Coefficients of b1 only count in the lowest bit of a nibble; here are their other bits.
  uint flips = (c.y & 0xeeeeu) | ((c.z >> 1) & 0x1111u);
  uint p = owen_nibbles(sobol_nibbles(owen_index(rng.iteration % SOBOL_BLOCK, flips)), c);
  // x >> 4 as a product: with a shift, compilers make funnel shifts, which Oclgrind does not know.
  const uint sixteenth = 0x10000000u;
  U4 v;
  v.x = (p << 28) | high_word(below.x, sixteenth);
  v.y = ((p >> 4) << 28) | high_word(below.y, sixteenth);
  v.z = ((p >> 8) << 28) | high_word(below.z, sixteenth);
  v.w = ((p >> 12) << 28) | high_word(below.w, sixteenth);
  return v;
}

#endif

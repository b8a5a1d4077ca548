// Random numbers as a pure function of (seed, iteration, path, dimension): no state, so neither the
// work-group size nor the pass split nor an interruption changes them.
#ifndef PELLUCID_CORE_RNG_H
#define PELLUCID_CORE_RNG_H

#include "core/real.h"

/// Table of dimensions: blocks of four numbers each.
#define DIM_PIXEL 0u                           /* x, y within the pixel */
#define DIM_BSDF(bounce) (1u + 2u * (bounce))  /* x lobe, y z direction, w roulette */
#define DIM_LIGHT(bounce) (2u + 2u * (bounce)) /* words x w pick, y z point */

typedef struct Rng {
  uint path;       // pixel or light path index
  uint iteration;  // global pass number
  uint seed;
} Rng;

/// Four numbers in [0, 1), multiples of 2^-24 (so that 1 is never reached).
typedef struct Random4 {
  real x, y, z, w;
} Random4;

/// Four hashed words of (path, iteration, dimension, seed): pcg4d of [Jarzynski20].
INLINE U4 rng_words(Rng rng, uint dimension) {
  U4 v;
  v.x = rng.path * 1664525u + 1013904223u;
  v.y = rng.iteration * 1664525u + 1013904223u;
  v.z = dimension * 1664525u + 1013904223u;
  v.w = rng.seed * 1664525u + 1013904223u;
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  v.x ^= v.x >> 16;
  v.y ^= v.y >> 16;
  v.z ^= v.z >> 16;
  v.w ^= v.w >> 16;
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  return v;
}

/// A word as a number in [0, 1): the upper 24 bits, exact in float.
INLINE real rng_unit(uint word) {
  return (real)(word >> 8) * REAL(5.9604644775390625e-8);
}

INLINE Random4 rng4(Rng rng, uint dimension) {
  U4 v = rng_words(rng, dimension);
  Random4 u;
  u.x = rng_unit(v.x);
  u.y = rng_unit(v.y);
  u.z = rng_unit(v.z);
  u.w = rng_unit(v.w);
  return u;
}

#endif

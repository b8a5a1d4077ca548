// Numbers for paths: which dimension is for what, and words and numbers of a block of dimensions by
// the sampler that the kernel is built for.
#ifndef PELLUCID_CORE_RNG_H
#define PELLUCID_CORE_RNG_H

#include "core/sobol.h"

/// Table of dimensions: blocks of four numbers each. Sobol points stratify the pairs xy, yz and zw
/// best (core/sobol.h), so what belongs together stands side by side.
#define DIM_PIXEL 0u                           /* x, y within the pixel */
#define DIM_BSDF(bounce) (1u + 2u * (bounce))  /* x lobe, y z direction, w roulette */
#define DIM_LIGHT(bounce) (2u + 2u * (bounce)) /* words x w pick, y z point */

// Walks from lights count apart: path n from the eye and path n from the lights share nothing. The
// hash mixes the highest bits of a dimension into few others, so the two differ in its middle.
#define DIM_LIGHT_WALK 0x09e30000u
#define DIM_EMIT_POINT DIM_LIGHT_WALK            /* x w pick, y z point */
#define DIM_EMIT_DIRECTION (DIM_LIGHT_WALK + 1u) /* x y direction, z side */
/* As DIM_BSDF (w, if the walk survives: images of directions, transport/facet.h); and x y, by which
 * the filter picks a splat's pixel. */
#define DIM_LIGHT_WALK_BSDF(bounce) (DIM_LIGHT_WALK + 2u + 2u * (bounce))
#define DIM_LIGHT_WALK_SPLAT(bounce) (DIM_LIGHT_WALK + 3u + 2u * (bounce))

/// Four numbers in [0, 1), multiples of 2^-24 (so that 1 is never reached).
typedef struct Random4 {
  real x, y, z, w;
} Random4;

/// Four words of (path, iteration, dimension, seed).
INLINE U4 rng_words(Rng rng, uint dimension) {
#if INTG_SOBOL
  return sobol_words(rng, dimension);
#else
  return random_words(rng, dimension);
#endif
}

#define RNG_STEP REAL(5.9604644775390625e-8)   /* 2^-24, between numbers drawn in [0, 1) */
#define WORD_STEP REAL(2.3283064365386963e-10) /* 2^-32, of a whole word as a share of 1 */

/// A word as a number in [0, 1): the upper 24 bits, exact in float.
INLINE real rng_unit(uint word) {
  return (real)(word >> 8) * RNG_STEP;
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

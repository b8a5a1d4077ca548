// Hashed words as a pure function of (seed, iteration, path, dimension): no state, so neither the
// work-group size nor the pass split nor an interruption changes them.
#ifndef PELLUCID_CORE_RANDOM_H
#define PELLUCID_CORE_RANDOM_H

#include "core/real.h"

typedef struct Rng {
  uint path;       // pixel or light path index
  uint iteration;  // global pass number
  uint seed;
} Rng;

/// Four hashed words of (path, iteration, dimension, seed): pcg4d of [Jarzynski20].
INLINE U4 random_words(Rng rng, uint dimension) {
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

#endif

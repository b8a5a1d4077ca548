// Pixel filters by importance sampling: film positions are drawn from the filter around the pixel's
// centre, so every sample has weight 1 and no pixel knows of its neighbours [Ernst06].
#ifndef PELLUCID_CAMERA_FILTER_H
#define PELLUCID_CAMERA_FILTER_H

#include "core/rng.h"

/// A point of the film in pixels from the top left.
typedef struct FilmPosition {
  real x, y;
} FilmPosition;

/// Offset from the pixel's centre [pixels] for u in [0, 1), the inverse of the filter's integral.
/// The table holds |offset| over r = sqrt(share of the filter further out): steps are even in r,
/// since towards the edge, where filters fade, the offset is smooth in r but not in u. The largest
/// error of the filter's integral is below 1e-6 for all filters (a test measures it).
INLINE real filter_offset(GLOBAL const float* filter_table, real u) {
  // Half a step of u makes u and its mirror image exact opposites; both lines are exact in float.
  real t = REAL(2.0) * u - REAL(1.0) + RNG_STEP;
  real r = r_sqrt(REAL(1.0) - r_abs(t)) * (real)FILTER_STEPS;
  uint k = (uint)r;
  k = k < FILTER_STEPS - 1u ? k : FILTER_STEPS - 1u;
  real low = (real)filter_table[k], high = (real)filter_table[k + 1u];
  return sign_of(low + (high - low) * (r - (real)k), t);
}

#if INTG_FILTER
/// The filter [1/pixel] at an offset given in steps of FILTER_STEPS to its radius; 0 beyond.
INLINE real filter_value(GLOBAL const float* filter_values, real step) {
  uint k = (uint)step;
  if (k >= FILTER_STEPS) return REAL(0.0);
  real low = (real)filter_values[k], high = (real)filter_values[k + 1u];
  return low + (high - low) * (step - (real)k);
}

/// Of the pixels whose filter reaches film coordinate x, one drawn in proportion to the filter
/// there; *weight: the sum over all of them, about 1. So splats get the filter that samples are
/// drawn from.
INLINE int filter_pixel(GLOBAL const float* filter_table, GLOBAL const float* filter_values, real x,
                        real u, PRIVATE real* weight) {
  real radius = (real)filter_table[0], to_step = (real)FILTER_STEPS / radius;
  int first = (int)r_floor(x - radius + REAL(0.5)), last = (int)r_floor(x + radius - REAL(0.5));
  *weight = REAL(0.0);
  for (int j = first; j <= last; ++j)
    *weight += filter_value(filter_values, r_abs(x - (real)j - REAL(0.5)) * to_step);
  real rest = u * *weight;
  for (int j = first; j < last; ++j) {
    rest -= filter_value(filter_values, r_abs(x - (real)j - REAL(0.5)) * to_step);
    if (rest < REAL(0.0)) return j;
  }
  return last;
}
#endif

/// Where a sample of the pixel (column, row) meets the film, by u.x and u.y.
INLINE FilmPosition film_position(GLOBAL const float* filter_table, uint column, uint row,
                                  Random4 u) {
  FilmPosition at;
#if INTG_FILTER
  at.x = (real)column + REAL(0.5) + filter_offset(filter_table, u.x);
  at.y = (real)row + REAL(0.5) + filter_offset(filter_table, u.y);
#else
  at.x = (real)column + u.x;
  at.y = (real)row + u.y;
#endif
  return at;
}

#endif

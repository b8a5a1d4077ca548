// The film: sums that do not stall, variance, and splats whose sums do not depend on order.
#ifndef PELLUCID_FILM_FILM_H
#define PELLUCID_FILM_FILM_H

#include "core/real.h"
#include "shared/buffers.h"
#include "shared/limits.h"

/// Adds x to the two-float sum (high, low) [Knuth TwoSum, then renormalised]: the error of n
/// additions stays near 2^-48 n instead of 2^-24 n. Correct for any order of magnitudes; needs
/// strict arithmetic.
INLINE void sum_add(PRIVATE float* high, PRIVATE float* low, float x) {
  float a = *high;
  float s = a + x;
  float bb = s - a;
  float error = (a - (s - bb)) + (x - bb);
  float l = *low + error;
  *high = s + l;
  *low = l - (*high - s);
}

INLINE void sum_add3(PRIVATE F4* high, PRIVATE F4* low, float x, float y, float z) {
  float hx = high->x, hy = high->y, hz = high->z;
  float lx = low->x, ly = low->y, lz = low->z;
  sum_add(&hx, &lx, x);
  sum_add(&hy, &ly, y);
  sum_add(&hz, &lz, z);
  high->x = hx, high->y = hy, high->z = hz;
  low->x = lx, low->y = ly, low->z = lz;
}

INLINE int float_is_finite(float x) {
#if PELLUCID_DEVICE
  return (as_uint(x) & 0x7f800000u) != 0x7f800000u;
#else
  return std::isfinite(x);
#endif
}

/// Adds one iteration's value of a pixel (w: its rays). A non-finite or negative value is dropped
/// (its pixel gets 0 for the iteration) and counted.
INLINE void film_accumulate(GLOBAL FilmPixel* pixel, GLOBAL uint* diag, F4 sample) {
  FilmPixel p = *pixel;
  int bad = 0;
  if (!float_is_finite(sample.x) || !float_is_finite(sample.y) || !float_is_finite(sample.z))
    bad = 1 + DIAG_nonfinite;
  else if (sample.x < 0.0f || sample.y < 0.0f || sample.z < 0.0f)
    bad = 1 + DIAG_negative;
  if (bad) {
#if PELLUCID_DEVICE
    atomic_inc(&diag[bad - 1]);
#else
    ++diag[bad - 1];
#endif
  } else {
    sum_add3(&p.sum, &p.sum_low, sample.x, sample.y, sample.z);
    sum_add3(&p.square, &p.square_low, sample.x * sample.x, sample.y * sample.y,
             sample.z * sample.z);
  }
  uint rays = (uint)sample.w;
  p.count.x += 1u;
  p.count.y += rays;
  p.count.z += p.count.y < rays ? 1u : 0u;
  *pixel = p;
}

#if PELLUCID_DEVICE

/// Adds `steps` to a 64-bit counter kept as two words, low first. Integer sums are the same in any
/// order, so splats do not depend on scheduling. Without 64-bit atomics the carry goes by hand.
INLINE void splat_word(__global uint* word, ulong steps) {
#if DEV_INT64_ATOMICS
  atom_add((__global ulong*)word, steps);
#else
  uint low = (uint)steps;
  uint old = atomic_add(&word[0], low);
  uint carry = (old + low) < old ? 1u : 0u;
  uint high = (uint)(steps >> 32) + carry;
  if (high) atomic_add(&word[1], high);
#endif
}

/// Steps of one channel; too large a value is cut and counted.
INLINE ulong splat_steps(float value, float scale, __global uint* diag) {
  float steps = value * scale;
  if (steps > SPLAT_FIXED_MAX) {
    atomic_inc(&diag[DIAG_splat_saturated]);
    steps = SPLAT_FIXED_MAX;
  }
  return convert_ulong_rte(steps);
}

/// Adds a contribution to pixel (x, y) of the whole picture, if it lies in the tile, from any
/// work-item.
INLINE void film_splat(__global uint* splats, __global uint* diag, Launch launch, int x, int y,
                       float r, float g, float b) {
  x -= (int)launch.tile_x;
  y -= (int)launch.tile_y;
  if (x < 0 || y < 0 || x >= (int)launch.tile_width || y >= (int)launch.tile_height) {
    atomic_inc(&diag[DIAG_splat_outside]);
    return;
  }
  if (!float_is_finite(r) || !float_is_finite(g) || !float_is_finite(b)) {
    atomic_inc(&diag[DIAG_nonfinite]);
    return;
  }
  if (r < 0.0f || g < 0.0f || b < 0.0f) {
    atomic_inc(&diag[DIAG_negative]);
    return;
  }
  __global uint* word = splats + ((size_t)y * launch.tile_width + (size_t)x) * 6;
  splat_word(word, splat_steps(r, launch.splat_scale, diag));
  splat_word(word + 2, splat_steps(g, launch.splat_scale, diag));
  splat_word(word + 4, splat_steps(b, launch.splat_scale, diag));
}

/// A splat counter as radiance.
INLINE float splat_value(__global const uint* word, float scale) {
  return ((float)word[1] * 4294967296.0f + (float)word[0]) / scale;
}

#endif

#endif

// The film: sums that do not stall, variance, and splats whose sums do not depend on order.
#ifndef PELLUCID_FILM_FILM_H
#define PELLUCID_FILM_FILM_H

#include "core/codes.h"
#include "shared/buffers.h"
#include "shared/film_sums.h"

/// A channel's sample in steps of 2^lsb; *flaw receives 1 + counter where it does not fit.
INLINE WideValue film_steps(float x, int lsb, PRIVATE int* flaw) {
  WideValue v = wide_from_float(float_bits(x));
  v.exponent -= lsb;
  if (v.exponent > FILM_SAMPLE_BITS - 24) {
    *flaw = 1 + DIAG_film_saturated;
    v.mantissa = 0xffffffu;
    v.exponent = FILM_SAMPLE_BITS - 24;
  }
  return wide_round(v);
}

/// Adds one iteration's channel: to the block under way, or, where every iteration is a block, to
/// the sums.
INLINE void film_add_channel(GLOBAL FilmPixel* pixel, int c, WideValue v) {
#if INTG_SOBOL
  wide_add(pixel->block[c], FILM_SUM_WORDS, v);
#else
  wide_add(pixel->sum[c], FILM_SUM_WORDS, v);
  wide_add(pixel->square[c], FILM_SQUARE_WORDS, wide_square(v, FILM_SQUARE_DROP));
#endif
}

/// Adds rays, of which there may be more than 2^32, to the pixel's number of them.
INLINE void film_count(GLOBAL FilmPixel* pixel, uint low, uint high) {
  uint sum = pixel->count[1] + low;
  pixel->count[1] = sum;
  pixel->count[2] += high + (sum < low ? 1u : 0u);
}

/// Adds one iteration's value of a pixel (w: its rays). A non-finite or negative value is dropped
/// (its pixel gets 0 for the iteration) and counted.
INLINE void film_accumulate(GLOBAL FilmPixel* pixel, GLOBAL uint* diag, Launch launch, F4 sample) {
  int flaw = 0;
  float peak = PEAK_DROPPED;
  if (!is_finite(sample.x) || !is_finite(sample.y) || !is_finite(sample.z)) {
    flaw = 1 + DIAG_nonfinite;
  } else if (sample.x < 0.0f || sample.y < 0.0f || sample.z < 0.0f) {
    flaw = 1 + DIAG_negative;
  } else {
    film_add_channel(pixel, 0, film_steps(sample.x, launch.film_lsb, &flaw));
    film_add_channel(pixel, 1, film_steps(sample.y, launch.film_lsb, &flaw));
    film_add_channel(pixel, 2, film_steps(sample.z, launch.film_lsb, &flaw));
    peak = LUMINANCE_R * sample.x + LUMINANCE_G * sample.y + LUMINANCE_B * sample.z;
  }
  film_keep_peak(pixel, peak, launch.iteration);
  if (flaw) diag_add(diag, (uint)(flaw - 1));
#if INTG_SOBOL
  if (launch.block_ends) film_end_block(pixel);
#endif
  film_count(pixel, (uint)sample.w, 0u);
  pixel->count[0] += 1u;
}

#if PELLUCID_DEVICE

/// Whether the rendered part of the picture has pixel (x, y) of the whole.
INLINE int film_in_window(Launch launch, int x, int y) {
  return x >= (int)launch.window_x && y >= (int)launch.window_y &&
         x < (int)(launch.window_x + launch.window_width) &&
         y < (int)(launch.window_y + launch.window_height);
}

/// Whether the tile has pixel (x, y) of the whole picture.
INLINE int film_in_tile(Launch launch, int x, int y) {
  return x >= (int)launch.tile_x && y >= (int)launch.tile_y &&
         x < (int)(launch.tile_x + launch.tile_width) &&
         y < (int)(launch.tile_y + launch.tile_height);
}

/// Place in the tile of a pixel that it has.
INLINE uint film_pixel(Launch launch, int x, int y) {
  return ((uint)y - launch.tile_y) * launch.tile_width + ((uint)x - launch.tile_x);
}

/// Adds `steps` to a 64-bit counter kept as two words, low first. Integer sums are the same in any
/// order, so splats do not depend on scheduling. Without 64-bit atomics the carry goes by hand. 1:
/// the sum left 64 bits.
INLINE int sum_steps(__global uint* word, ulong steps) {
#if DEV_INT64_ATOMICS
  ulong before = atom_add((__global ulong*)word, steps);
  return before + steps < before;
#else
  uint low = (uint)steps;
  uint old = atomic_add(&word[0], low);
  uint carry = (old + low) < old ? 1u : 0u;
  uint high = (uint)(steps >> 32) + carry;
  if (!high) return 0;
  uint old_high = atomic_add(&word[1], high);
  return old_high + high < old_high;
#endif
}

/// The same of a splat: a sum that leaves 64 bits is counted by `saturated`.
INLINE void splat_word(__global uint* word, __global uint* diag, ulong steps, uint saturated) {
  if (sum_steps(word, steps)) diag_add(diag, saturated);
}

/// Steps of one channel; too large a value is cut and counted by `saturated`.
INLINE ulong splat_steps(float value, float scale, __global uint* diag, uint saturated) {
  float steps = value * scale;
  if (steps > SPLAT_FIXED_MAX) {
    diag_add(diag, saturated);
    steps = SPLAT_FIXED_MAX;
  }
  return convert_ulong_rte(steps);
}

/// Adds a path's throughput to what --max-depth cut off (CUT_*). The sum is emptied after every
/// batch of passes, of far fewer paths than 2^32.
INLINE void cut_add(__global uint* diag, uint kind, float share) {
  if (share == 0.0f) return;
  float kept = share < CUT_SHARE_MAX ? share : CUT_SHARE_MAX;  // NaN, too, shows as the largest
  sum_steps(diag + DIAG_CUTS + 2u * kind, convert_ulong_rte(kept * CUT_STEPS));
}

/// Adds a contribution to pixel (x, y) of the whole picture, if it lies in the tile, from any
/// work-item.
INLINE void film_splat(__global uint* splats, __global uint* diag, Launch launch, int x, int y,
                       float r, float g, float b) {
  if (!film_in_tile(launch, x, y)) {
    diag_add(diag, DIAG_splat_outside);
    return;
  }
  if (!is_finite(r) || !is_finite(g) || !is_finite(b)) {
    diag_add(diag, DIAG_nonfinite);
    return;
  }
  if (r < 0.0f || g < 0.0f || b < 0.0f) {
    diag_add(diag, DIAG_negative);
    return;
  }
  const uint saturated = DIAG_splat_saturated;
  __global uint* word = splats + (size_t)film_pixel(launch, x, y) * SPLAT_WORDS;
  splat_word(word, diag, splat_steps(r, launch.splat_scale, diag, saturated), saturated);
  splat_word(word + 2, diag, splat_steps(g, launch.splat_scale, diag, saturated), saturated);
  splat_word(word + 4, diag, splat_steps(b, launch.splat_scale, diag, saturated), saturated);
}

/// Books the rays of a light path on a pixel of the window, so that no pixel gets many at once and
/// that bands, which trace it again, do not count it again. 0: another band does.
INLINE int film_count_rays(__global uint* splats, __global uint* diag, Launch launch, uint path,
                           uint rays) {
  uint home = path % (launch.window_width * launch.window_height);
  int x = (int)(launch.window_x + home % launch.window_width);
  int y = (int)(launch.window_y + home / launch.window_width);
  if (!film_in_tile(launch, x, y)) return 0;
  splat_word(splats + (size_t)film_pixel(launch, x, y) * SPLAT_WORDS + 6, diag, rays,
             DIAG_splat_saturated);
  return 1;
}

#define WORD_RANGE 4294967296.0f /* 2^32 */

/// A splat counter as radiance.
INLINE float splat_value(__global const uint* word, float scale) {
  return ((float)word[1] * WORD_RANGE + (float)word[0]) / scale;
}

#endif

#endif

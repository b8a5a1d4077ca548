// What kernels and host both do to a pixel's sums.
#ifndef PELLUCID_SHARED_FILM_SUMS_H
#define PELLUCID_SHARED_FILM_SUMS_H

#include "shared/layout.h"
#include "shared/limits.h"
#include "shared/wide.h"

/// Remembers the brightest sample of the pixel, and of equal ones the first; one that was dropped
/// counts as the brightest (PEAK_DROPPED).
INLINE void film_keep_peak(GLOBAL FilmPixel* pixel, float luminance, uint pass) {
  if (luminance < pixel->peak) return;
  if (luminance == pixel->peak && (luminance == 0.0f || pass >= pixel->peak_pass)) return;
  pixel->peak = luminance;
  pixel->peak_pass = pass;
}

/// Ends the block under way: its total joins the sum, the total's square the squares.
INLINE void film_end_block(GLOBAL FilmPixel* pixel) {
  for (int c = 0; c < 3; ++c) {
    WideValue total = wide_top(pixel->block[c], FILM_SUM_WORDS);
    wide_add(pixel->square[c], FILM_SQUARE_WORDS, wide_square(total, FILM_SQUARE_DROP));
    wide_add_words(pixel->sum[c], pixel->block[c], FILM_SUM_WORDS);
    for (int i = 0; i < FILM_SUM_WORDS; ++i) pixel->block[c][i] = 0u;
  }
}

#endif

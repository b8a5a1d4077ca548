// What kernels and host both do to a pixel's sums.
#ifndef PELLUCID_SHARED_FILM_SUMS_H
#define PELLUCID_SHARED_FILM_SUMS_H

#include "shared/layout.h"
#include "shared/limits.h"
#include "shared/wide.h"

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

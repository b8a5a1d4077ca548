// The film as the host sees it: means, variances and counts out of the device's accumulators.
#pragma once

#include <cstdint>
#include <vector>

#include "image/image.h"
#include "shared/layout.h"

namespace pellucid {

struct FilmSummary {
  std::uint64_t iterations = 0;  ///< of each pixel
  std::uint64_t rays = 0;        ///< of all pixels
  double mean = 0;               ///< of pixels and channels
  double relmse = 0;  ///< estimated from the variances: mean of var/(mean^2 + e^2), e = 1 % of the
                      ///< mean; NaN below 2 iterations or where squares left the range of float
};

FilmSummary summarise(const std::vector<FilmPixel>& film);

/// R G B means; with `variance` also variance.R/G/B, the variance of those means (unbiased, 0 below
/// 2 iterations); with `samples` also the number of iterations.
Image film_image(const std::vector<FilmPixel>& film, int width, int height, bool variance,
                 bool samples);

}  // namespace pellucid

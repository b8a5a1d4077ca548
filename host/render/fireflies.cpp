// Ranking of pixels by what their brightest sample does to them.
#include "render/fireflies.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/relmse.h"
#include "shared/limits.h"

namespace pellucid {
namespace {

/// Sum of the luminances of a pixel's samples.
double luminance_sum(const Film& film, std::size_t pixel) {
  const Film::Sums sums = film.sums(pixel);
  return double(LUMINANCE_R) * sums.sum[0] + double(LUMINANCE_G) * sums.sum[1] +
         double(LUMINANCE_B) * sums.sum[2];
}

}  // namespace

std::vector<Firefly> fireflies(const Film& film, std::size_t count) {
  const auto passes = double(film.passes.count());
  std::vector<double> sums(film.pixels.size());
  double total = 0;
  for (std::size_t i = 0; i < sums.size(); ++i) total += sums[i] = luminance_sum(film, i);
  const double dark = RELMSE_EPSILON * total / (passes * double(sums.size()));
  std::vector<Firefly> all;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const FilmPixel& pixel = film.pixels[i];
    if (!(pixel.peak > 0)) continue;
    Firefly f;
    f.x = film.window.x0 + int(i % std::size_t(film.window.width));
    f.y = film.window.y0 + int(i / std::size_t(film.window.width));
    f.pass = pixel.peak_pass;
    f.dropped = pixel.peak == PEAK_DROPPED;
    if (f.dropped) {
      f.luminance = std::numeric_limits<double>::quiet_NaN();
      f.others = sums[i] / passes;
      f.excess = std::numeric_limits<double>::infinity();
      all.push_back(f);
      continue;
    }
    f.luminance = double(pixel.peak);
    f.others = passes > 1 ? std::max(0.0, sums[i] - f.luminance) / (passes - 1)
                          : std::numeric_limits<double>::quiet_NaN();
    const double without = passes > 1 ? f.others : 0.0;
    f.excess = (f.luminance - without) / passes / std::hypot(without, dark);
    all.push_back(f);
  }
  const auto more = [](const Firefly& a, const Firefly& b) {
    return a.excess != b.excess ? a.excess > b.excess : a.y != b.y ? a.y < b.y : a.x < b.x;
  };
  const std::size_t kept = std::min(count, all.size());
  std::partial_sort(all.begin(), all.begin() + std::ptrdiff_t(kept), all.end(), more);
  all.resize(kept);
  return all;
}

}  // namespace pellucid

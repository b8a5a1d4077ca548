// Statistics of the accumulators, in double.
#include "render/film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace pellucid {
namespace {

struct PixelStats {
  std::array<double, 3> mean{}, variance_of_mean{};
};

PixelStats stats_of(const FilmPixel& p) {
  PixelStats s;
  const double n = p.count.x;
  if (n == 0) return s;
  const double sum[3] = {double(p.sum.x) + p.sum_low.x, double(p.sum.y) + p.sum_low.y,
                         double(p.sum.z) + p.sum_low.z};
  const double square[3] = {double(p.square.x) + p.square_low.x,
                            double(p.square.y) + p.square_low.y,
                            double(p.square.z) + p.square_low.z};
  for (size_t c = 0; c < 3; ++c) {
    s.mean[c] = sum[c] / n;
    if (n >= 2) {
      // Squares left the range of float: the variance is unknown, which is not the same as 0.
      if (!std::isfinite(square[c]) || (square[c] == 0 && sum[c] != 0)) {
        s.variance_of_mean[c] = std::numeric_limits<double>::quiet_NaN();
        continue;
      }
      // Squares were rounded to float one by one: below that noise the variance counts as 0.
      const double spread = square[c] - sum[c] * sum[c] / n;
      s.variance_of_mean[c] = std::max(0.0, spread) / ((n - 1) * n);
    }
  }
  return s;
}

}  // namespace

FilmSummary summarise(const std::vector<FilmPixel>& film) {
  FilmSummary out;
  if (film.empty()) return out;
  out.iterations = film[0].count.x;
  double sum = 0;
  for (const FilmPixel& p : film) {
    out.rays += (std::uint64_t{p.count.z} << 32) + p.count.y;
    for (double m : stats_of(p).mean) sum += m;
  }
  const double values = 3.0 * double(film.size());
  out.mean = sum / values;
  if (out.iterations < 2) {
    out.relmse = std::numeric_limits<double>::quiet_NaN();
    return out;
  }
  const double e2 = 1e-4 * out.mean * out.mean;  // e = 1 % of the mean
  for (const FilmPixel& p : film) {
    const PixelStats s = stats_of(p);
    for (size_t c = 0; c < 3; ++c) {
      const double below = s.mean[c] * s.mean[c] + e2;
      out.relmse += below > 0 ? s.variance_of_mean[c] / below / values : 0;
    }
  }
  return out;
}

Image film_image(const std::vector<FilmPixel>& film, int width, int height, bool variance,
                 bool samples) {
  PELLUCID_CHECK(film.size() == size_t(width) * size_t(height), "film size");
  Image image;
  image.width = width;
  image.height = height;
  image.channels = {"R", "G", "B"};
  if (variance)
    image.channels.insert(image.channels.end(), {"variance.R", "variance.G", "variance.B"});
  if (samples) image.channels.push_back("samples");
  image.data.reserve(film.size() * image.channels.size());
  for (const FilmPixel& p : film) {
    const PixelStats s = stats_of(p);
    for (double m : s.mean) image.data.push_back(float(m));
    if (variance)
      for (double v : s.variance_of_mean) image.data.push_back(float(v));
    if (samples) image.data.push_back(float(p.count.x));
  }
  return image;
}

}  // namespace pellucid

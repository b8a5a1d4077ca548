// Metrics in double; one pass for the mean of the reference, one for everything else.
#include "image/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/text.h"

namespace pellucid {
namespace {

constexpr int TILE = 16;  // pixels, the unit in which error is called local
constexpr double PERCENTILE = 0.95;
constexpr double EPSILON_OF_MEAN = 0.01;  // relative to exposure, so exposure changes no ranking
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// Which channels hold colour: R,G,B, or the only one there is beside an alpha.
std::vector<std::size_t> colour_channels(const Image& image) {
  const int r = image.channel("R"), g = image.channel("G"), b = image.channel("B");
  if (r >= 0 && g >= 0 && b >= 0) return {std::size_t(r), std::size_t(g), std::size_t(b)};
  const int y = image.channel("Y");
  if (y >= 0) return {std::size_t(y)};
  if (image.channels.size() == 1) return {0};
  throw InputError(
      fmt::format("an image to be compared needs channels R, G, B or a single one; it has {}",
                  join(image.channels)));
}

double quotient(double error, double scale) {
  return error == 0.0 ? 0.0 : error / scale;
}

/// The colour values of two images of equal shape.
class Pair {
 public:
  Pair(const Image& a, const Image& b)
      : a_(a), b_(b), a_channels_(colour_channels(a)), b_channels_(colour_channels(b)) {
    if (a.width != b.width || a.height != b.height)
      throw InputError(
          fmt::format("sizes differ: {}x{} against {}x{}", a.width, a.height, b.width, b.height));
    if (a_channels_.size() != b_channels_.size())
      throw InputError(fmt::format("colour channels differ: {} against {}", a_channels_.size(),
                                   b_channels_.size()));
  }
  std::size_t pixels() const { return std::size_t(a_.width) * std::size_t(a_.height); }
  std::size_t colours() const { return a_channels_.size(); }
  double a(std::size_t pixel, std::size_t c) const {
    return a_.data[pixel * a_.channels.size() + a_channels_[c]];
  }
  double b(std::size_t pixel, std::size_t c) const {
    return b_.data[pixel * b_.channels.size() + b_channels_[c]];
  }
  bool finite(std::size_t pixel) const {
    for (std::size_t c = 0; c < colours(); ++c)
      if (!std::isfinite(a(pixel, c)) || !std::isfinite(b(pixel, c))) return false;
    return true;
  }
  /// e of metrics.h, over the finite pixels.
  double epsilon() const {
    double sum = 0, count = 0;
    for (std::size_t p = 0; p < pixels(); ++p) {
      if (!finite(p)) continue;
      for (std::size_t c = 0; c < colours(); ++c) sum += b(p, c);
      count += static_cast<double>(colours());
    }
    return quotient(EPSILON_OF_MEAN * std::abs(sum), count);
  }
  /// relMSE of one pixel.
  double relmse(std::size_t pixel, double e) const {
    double sum = 0;
    for (std::size_t c = 0; c < colours(); ++c) {
      const double difference = a(pixel, c) - b(pixel, c), reference = b(pixel, c);
      sum += quotient(difference * difference, reference * reference + e * e);
    }
    return sum / static_cast<double>(colours());
  }

 private:
  const Image &a_, &b_;
  std::vector<std::size_t> a_channels_, b_channels_;
};

double percentile_of_tiles(const Pair& pair, int width, int height, double e) {
  std::vector<double> tiles;
  for (int y0 = 0; y0 < height; y0 += TILE) {
    for (int x0 = 0; x0 < width; x0 += TILE) {
      const int y1 = std::min(y0 + TILE, height), x1 = std::min(x0 + TILE, width);
      double sum = 0;
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x)
          sum += pair.relmse(std::size_t(y) * std::size_t(width) + std::size_t(x), e);
      tiles.push_back(sum / (double(x1 - x0) * (y1 - y0)));
    }
  }
  const auto rank = std::size_t(std::ceil(PERCENTILE * static_cast<double>(tiles.size()))) - 1;
  std::nth_element(tiles.begin(), tiles.begin() + std::ptrdiff_t(rank), tiles.end());
  return tiles[rank];
}

}  // namespace

ImageError compare_images(const Image& a, const Image& reference) {
  const Pair pair(a, reference);
  ImageError error;
  for (std::size_t p = 0; p < pair.pixels(); ++p) error.nonfinite += pair.finite(p) ? 0 : 1;
  if (error.nonfinite > 0) {
    error.mse = error.rmse = error.relmse = error.smape = NaN;
    error.energy_ratio = error.p95_tile_relmse = NaN;
    return error;
  }

  const double e = pair.epsilon();
  double sum_a = 0, sum_b = 0;
  for (std::size_t p = 0; p < pair.pixels(); ++p) {
    for (std::size_t c = 0; c < pair.colours(); ++c) {
      const double x = pair.a(p, c), ref = pair.b(p, c), difference = x - ref;
      error.mse += difference * difference;
      error.smape += quotient(2 * std::abs(difference), std::abs(x) + std::abs(ref) + e);
      sum_a += x;
      sum_b += ref;
    }
    error.relmse += pair.relmse(p, e);
  }
  const auto pixels = static_cast<double>(pair.pixels());
  const double values = pixels * static_cast<double>(pair.colours());
  error.mse /= values;
  error.rmse = std::sqrt(error.mse);
  error.smape /= values;
  error.relmse /= pixels;
  error.energy_ratio = sum_a == sum_b ? 1.0 : sum_a / sum_b;
  error.p95_tile_relmse = percentile_of_tiles(pair, a.width, a.height, e);
  return error;
}

Image error_map(const Image& a, const Image& reference) {
  const Pair pair(a, reference);
  const double e = pair.epsilon();
  Image map;
  map.width = a.width;
  map.height = a.height;
  map.channels = {"error"};
  map.data.reserve(pair.pixels());
  for (std::size_t p = 0; p < pair.pixels(); ++p)
    map.data.push_back(static_cast<float>(pair.finite(p) ? std::sqrt(pair.relmse(p, e)) : NaN));
  return map;
}

ChannelStatistics channel_statistics(const Image& image, std::size_t channel) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  ChannelStatistics s{infinity, 0.0, -infinity, 0};
  std::uint64_t finite = 0;
  for (std::size_t i = channel; i < image.data.size(); i += image.channels.size()) {
    const double value = image.data[i];
    if (!std::isfinite(value)) {
      ++s.nonfinite;
      continue;
    }
    ++finite;
    s.mean += value;
    s.min = std::min(s.min, value);
    s.max = std::max(s.max, value);
  }
  s.mean /= static_cast<double>(finite);  // 0 / 0 where there is none
  if (finite == 0) s.min = s.max = s.mean;
  return s;
}

}  // namespace pellucid

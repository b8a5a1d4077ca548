// Metrics in double; one pass for the mean of the reference, one for everything else.
#include "image/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pellucid {
namespace {

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// Nearest rank: the least of the values that a share of them does not exceed. Reorders them.
double percentile(std::vector<double>& values, double share) {
  const auto rank = std::size_t(std::ceil(share * static_cast<double>(values.size()))) - 1;
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(rank), values.end());
  return values[rank];
}

/// Mean without the largest 0.1 %. Reorders the values.
double trimmed_mean(std::vector<double>& values) {
  constexpr double dropped = 0.001;
  const auto kept =
      values.size() - std::size_t(std::floor(dropped * static_cast<double>(values.size())));
  if (kept < values.size())
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(kept), values.end());
  double sum = 0;
  for (std::size_t i = 0; i < kept; ++i) sum += values[i];
  return sum / static_cast<double>(kept);
}

/// 1 means that nothing sticks out. Reorders the values, which are means over colours.
double firefly_index(std::vector<double>& pixels) {
  const double most = *std::max_element(pixels.begin(), pixels.end());
  const double usual = percentile(pixels, 0.999);
  return most == usual ? 1.0 : most / usual;
}

double energy_ratio(double a, double b) {
  return a == b ? 1.0 : a / b;
}

void add_tiles(const ImagePair& pair, double e, ImageError& error) {
  constexpr double one_percent = 0.01;
  const std::vector<Tile> tiles = tiles_of(pair.width(), pair.height());
  std::vector<double> errors;
  for (const Tile& tile : tiles) {
    double sum = 0;
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) sum += pair.relmse(pair.pixel(x, y), e);
    errors.push_back(sum / tile.pixels());
    error.tiles_within_1pct += std::sqrt(errors.back()) <= one_percent ? 1 : 0;
  }
  error.tiles_within_1pct /= static_cast<double>(tiles.size());
  const auto worst = std::max_element(errors.begin(), errors.end());
  error.worst_tile_relmse = *worst;
  error.worst_tile = tiles[std::size_t(worst - errors.begin())];
  error.p95_tile_relmse = percentile(errors, 0.95);
}

void add_energy(const std::vector<double>& a, const std::vector<double>& b, ImageError& error) {
  double all_a = 0, all_b = 0;
  error.worst_channel_energy = 1;
  for (std::size_t c = 0; c < a.size(); ++c) {
    const double ratio = energy_ratio(a[c], b[c]);
    error.channel_energy.push_back(ratio);
    if (!(std::abs(ratio - 1) <= std::abs(error.worst_channel_energy - 1)))
      error.worst_channel_energy = ratio;
    all_a += a[c];
    all_b += b[c];
  }
  error.energy_ratio = energy_ratio(all_a, all_b);
}

/// What takes one look at every pixel.
void add_pixels(const ImagePair& pair, double e, ImageError& error) {
  const std::size_t colours = pair.colours();
  std::vector<double> terms, energy_a(colours), energy_b(colours), grey_a, grey_b;
  terms.reserve(pair.pixels() * colours);
  for (std::size_t p = 0; p < pair.pixels(); ++p) {
    grey_a.push_back(0);
    grey_b.push_back(0);
    for (std::size_t c = 0; c < colours; ++c) {
      const double x = pair.a(p, c), ref = pair.b(p, c), square = (x - ref) * (x - ref);
      error.mse += square;
      error.smape += quotient(2 * std::abs(x - ref), std::abs(x) + std::abs(ref) + e);
      terms.push_back(quotient(square, ref * ref + e * e));
      energy_a[c] += x;
      energy_b[c] += ref;
      grey_a.back() += x;
      grey_b.back() += ref;
    }
    error.relmse += pair.relmse(p, e);
  }
  const double values = static_cast<double>(pair.pixels() * colours);
  error.mse /= values;
  error.rmse = std::sqrt(error.mse);
  error.smape /= values;
  error.relmse /= static_cast<double>(pair.pixels());
  error.trimmed_relmse = trimmed_mean(terms);
  error.firefly_index = firefly_index(grey_a);
  error.reference_firefly_index = firefly_index(grey_b);
  add_energy(energy_a, energy_b, error);
}

/// One value per pixel; NaN where either image is not finite.
template <typename Value>
Image map_of(const Image& a, const Image& reference, const Value& value) {
  const ImagePair pair(a, reference);
  const double e = pair.epsilon();
  Image map;
  map.width = a.width;
  map.height = a.height;
  map.channels = {"error"};
  map.data.reserve(pair.pixels());
  for (std::size_t p = 0; p < pair.pixels(); ++p)
    map.data.push_back(static_cast<float>(pair.finite(p) ? value(pair, p, e) : NaN));
  return map;
}

}  // namespace

ImageError compare_images(const Image& a, const Image& reference) {
  const ImagePair pair(a, reference);
  ImageError error;
  error.nonfinite = pair.count_nonfinite();
  if (error.nonfinite > 0) {
    for (double ImageError::*metric :
         {&ImageError::mse, &ImageError::rmse, &ImageError::relmse, &ImageError::trimmed_relmse,
          &ImageError::smape, &ImageError::energy_ratio, &ImageError::worst_channel_energy,
          &ImageError::p95_tile_relmse, &ImageError::worst_tile_relmse,
          &ImageError::tiles_within_1pct, &ImageError::firefly_index,
          &ImageError::reference_firefly_index})
      error.*metric = NaN;
    error.channel_energy.assign(pair.colours(), NaN);
    return error;
  }
  const double e = pair.epsilon();
  add_pixels(pair, e, error);
  add_tiles(pair, e, error);
  return error;
}

Image error_map(const Image& a, const Image& reference) {
  return map_of(a, reference, [](const ImagePair& pair, std::size_t p, double e) {
    return std::sqrt(pair.relmse(p, e));
  });
}

Image signed_map(const Image& a, const Image& reference) {
  return map_of(a, reference, [](const ImagePair& pair, std::size_t p, double e) {
    return pair.signed_error(p, e);
  });
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

// Sums over tiles, all in double.
#include "study/tiles.h"

#include <algorithm>
#include <cmath>

#include "base/statistics.h"

namespace pellucid {
namespace {

/// value(i) of all values i of the picture, summed by tile.
template <typename F>
std::vector<double> tile_sums(const Tiling& tiling, F&& value) {
  std::vector<double> sums(std::size_t(tiling.count()));
  for (int y = 0; y < tiling.height; ++y)
    for (int x = 0; x < tiling.width; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        sums[std::size_t(tiling.of_pixel(x, y))] +=
            value(3 * (std::size_t(y) * std::size_t(tiling.width) + std::size_t(x)) + c);
  return sums;
}

/// Of a tile's energy over the pictures of a stack.
struct TileMean {
  double mean = 0, square_error = 0;
};

std::vector<TileMean> tile_means(const Tiling& tiling, const PictureStack& stack) {
  const double n = double(stack.size());
  std::vector<std::vector<double>> all;
  for (const Picture& picture : stack.pictures()) all.push_back(tile_energies(tiling, picture));
  std::vector<TileMean> means(std::size_t(tiling.count()));
  for (std::size_t tile = 0; tile < means.size(); ++tile) {
    for (const auto& energies : all) means[tile].mean += energies[tile] / n;
    for (const auto& energies : all)
      means[tile].square_error += std::pow(energies[tile] - means[tile].mean, 2) / (n - 1) / n;
  }
  return means;
}

}  // namespace

std::vector<double> tile_errors(const Tiling& tiling, const PictureStack& stack,
                                const Picture& reference, const std::vector<double>& weights) {
  const std::vector<double> values = tile_sums(tiling, [](std::size_t) { return 1.0; });
  std::vector<double> errors = tile_sums(tiling, [&](std::size_t i) {
    double sum = 0;
    for (const Picture& p : stack.pictures())
      sum += std::pow(double(p[i]) - double(reference[i]), 2) / double(stack.size());
    return weights[i] * sum;
  });
  for (std::size_t tile = 0; tile < errors.size(); ++tile) errors[tile] /= values[tile];
  return errors;
}

std::vector<double> tile_energies(const Tiling& tiling, const Picture& picture) {
  return tile_sums(tiling, [&](std::size_t i) { return double(picture[i]); });
}

TileDifference worst_tile(const Tiling& tiling, const PictureStack& a, const PictureStack& b,
                          double allowed) {
  const std::vector<TileMean> x = tile_means(tiling, a), y = tile_means(tiling, b);
  double mean = 0;
  for (const TileMean& tile : y) mean += std::abs(tile.mean) / double(y.size());
  TileDifference worst;
  for (std::size_t tile = 0; tile < x.size(); ++tile) {
    const double error = x[tile].square_error + y[tile].square_error;
    if (!(error > 0)) continue;
    // Welch and Satterthwaite's degrees of freedom.
    const double dof = error * error /
                       (std::pow(x[tile].square_error, 2) / (a.size() - 1) +
                        std::pow(y[tile].square_error, 2) / (b.size() - 1));
    const double free = allowed * (std::abs(y[tile].mean) + mean);
    const double apart = std::max(0.0, std::abs(x[tile].mean - y[tile].mean) - free);
    const double t = apart / std::sqrt(error);
    const double probability = 2 * student_cdf(-t, dof) * tiling.count();
    if (probability < worst.probability) worst = {int(tile), t, probability};
  }
  return worst;
}

}  // namespace pellucid

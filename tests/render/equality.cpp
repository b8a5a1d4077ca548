// Welch's test, and the verdict over image and tiles.
#include "equality.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "base/statistics.h"

namespace pellucid::test {
namespace {

struct MeanVariance {
  double mean = 0, variance = 0;  ///< of the mean
};

MeanVariance mean_variance(const Sample& s) {
  const double n = double(s.size());
  MeanVariance m;
  m.mean = std::accumulate(s.begin(), s.end(), 0.0) / n;
  for (double x : s) m.variance += (x - m.mean) * (x - m.mean) / (n * (n - 1));
  return m;
}

double mean_of(const Sample& s) {
  return mean_variance(s).mean;
}

}  // namespace

Estimate estimate(const Sample& sample) {
  const MeanVariance m = mean_variance(sample);
  return {m.mean, m.variance};
}

std::string welch(const Sample& a, const Sample& b, double alpha, double within) {
  const MeanVariance ma = mean_variance(a), mb = mean_variance(b);
  const double variance = ma.variance + mb.variance;
  const double off = std::abs(ma.mean - mb.mean);
  if (variance == 0) return off == 0 ? "" : fmt::format("WRONG: {} against {}", ma.mean, mb.mean);
  const double na = double(a.size()), nb = double(b.size());
  const double degrees =
      variance * variance /
      (ma.variance * ma.variance / (na - 1) + mb.variance * mb.variance / (nb - 1));
  const double width = -student_quantile(alpha / 2, std::floor(degrees)) * std::sqrt(variance);
  const std::string found = fmt::format(
      "{:.6g} against {:.6g}, off by {:.2g}, interval {:.2g}, "
      "allowed {:.2g}",
      ma.mean, mb.mean, off, width, within);
  if (!(off <= width)) return "WRONG: " + found;
  if (!(off + width <= within)) return "INCONCLUSIVE, too noisy: " + found;
  return "";
}

void Runs::add(const Picture& picture) {
  for (std::size_t c = 0; c < 3; ++c) {
    image[c].push_back(picture.image(int(c)).mean);
    std::size_t i = 0;
    for (int y = 0; y < picture.height; y += tile)
      for (int x = 0; x < picture.width; x += tile, ++i) {
        if (tiles[c].size() <= i) tiles[c].resize(i + 1), effective[c].resize(i + 1);
        tiles[c][i].push_back(picture.block_mean(int(c), x, y, tile));
        effective[c][i] += picture.effective_samples(int(c), x, y, tile);
      }
  }
}

std::vector<std::string> compare_runs(const Runs& a, const Runs& b, double alpha) {
  constexpr double matter = 300, tile_ratio = 10;  // full: +-0.5 % of the image, +-5 % of a tile
  std::vector<std::string> reasons;
  const auto say = [&](const std::string& where, const std::string& reason) {
    if (!reason.empty()) reasons.push_back(where + ": " + reason);
  };
  for (std::size_t c = 0; c < 3; ++c) {
    const double energy = mean_of(b.image[c]);
    say(fmt::format("image, channel {}", c),
        welch(a.image[c], b.image[c], alpha, tier_tolerance() * energy));
    const std::size_t n = b.tiles[c].size();
    std::size_t judged = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (std::min(a.effective[c][i], b.effective[c][i]) < matter) continue;
      ++judged;
      const double level = std::max(energy, mean_of(b.tiles[c][i]));
      say(fmt::format("tile {}, channel {}", i, c),
          welch(a.tiles[c][i], b.tiles[c][i], alpha / double(n),
                tile_ratio * tier_tolerance() * level));
    }
    if (2 * judged < n) say(fmt::format("channel {}", c), "INCONCLUSIVE: too few samples matter");
  }
  return reasons;
}

}  // namespace pellucid::test

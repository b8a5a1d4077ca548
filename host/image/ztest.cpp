// Means of regions, their variances and degrees of freedom from what pixels store.
#include "image/ztest.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/statistics.h"
#include "image/variances.h"

namespace pellucid {
namespace {

/// What pictures without any noise may differ by, as a part of their mean: sixteen roundings of
/// single precision.
constexpr double ARITHMETIC = 16 * 0x1p-24;

/// Passes whose spread makes a variance, at least one (blocks of Sobol points have so many).
constexpr double LONGEST_BLOCK = 16;

/// Sums over the pixels of a region, of one channel of one picture.
struct Region {
  double n = 0, sum = 0, squares = 0, variance = 0, deviation = 0, variance_squares = 0;

  void add(double value, double v) {
    n += 1;
    sum += value;
    squares += value * value;
    variance += v;
    deviation += std::sqrt(v);
    variance_squares += v * v;
  }
  Region& operator+=(const Region& r) {
    n += r.n, sum += r.sum, squares += r.squares;
    variance += r.variance, deviation += r.deviation, variance_squares += r.variance_squares;
    return *this;
  }
};

/// The mean of a region as one side has it.
struct Estimate {
  double mean = 0, variance = 0;
  double degrees = 1;  ///< of freedom of that variance
  double events = 0;   ///< samples that matter
};

using Channels = std::array<Region, 3>;
using Regions = std::vector<Channels>;  ///< by tile, and at the end the whole

/// Of the variance of one pixel, at least.
double pixel_degrees(double samples) {
  return std::max(1.0, std::floor(samples / LONGEST_BLOCK) - 1);
}

/// Samples that matter, (sum x)^2 / sum x^2 over samples: N of them have the variance N v.
double events(const Region& r, double samples) {
  const double squares = samples * r.variance + r.squares;
  return squares > 0 ? samples * r.sum * r.sum / squares
                     : std::numeric_limits<double>::infinity();  // black beyond doubt
}

/// Independent pixels' variances add up, and by Satterthwaite their sum has n (sum s)^2 / sum s^2
/// degrees of freedom, where s is true and n each pixel's own: few where few pixels make the noise.
/// Measured ones have E v^2 = s^2 (1 + 2/n). Whatever the dependence, a sum deviates by no more
/// than the sum of deviations; these may then all have been measured from the same blocks.
Estimate by_pixels(const Region& r, const NoisyImage& picture) {
  const double n = pixel_degrees(picture.samples), deviation = r.deviation / r.n;
  Estimate e{r.sum / r.n, deviation * deviation, n,
             events(r, picture.samples * double(picture.runs.size()))};
  if (!picture.independent_pixels) return e;
  e.variance = r.variance / (r.n * r.n);
  if (r.variance_squares > 0) e.degrees = (n + 2) * r.variance * r.variance / r.variance_squares;
  return e;
}

/// From what the means of runs differ by.
Estimate by_spread(const std::vector<Region>& runs, double samples) {
  const double k = double(runs.size());
  Estimate e{0, 0, k - 1, 0};
  for (const Region& r : runs) {
    e.mean += r.sum / r.n / k;
    e.events += events(r, samples);
  }
  for (const Region& r : runs) {
    const double off = r.sum / r.n - e.mean;
    e.variance += off * off / (k * (k - 1));
  }
  return e;
}

/// The values of `image`, in the order of its own colours.
Regions regions_of(const std::vector<Tile>& tiles, const Image& image) {
  const ImagePair pair(image, image);
  const Variances variances(image);
  const bool known = variances.stored();
  Regions all(tiles.size());
  for (std::size_t t = 0; t < tiles.size(); ++t)
    for (int y = tiles[t].y0; y < tiles[t].y1; ++y)
      for (int x = tiles[t].x0; x < tiles[t].x1; ++x)
        for (std::size_t c = 0; c < 3; ++c) {
          const std::size_t p = pair.pixel(x, y);
          all[t][c].add(pair.a(p, c), known ? variances(p, c) : 0.0);
        }
  Channels whole;
  for (const Channels& tile : all)
    for (std::size_t c = 0; c < 3; ++c) whole[c] += tile[c];
  all.push_back(whole);
  return all;
}

/// One side, by tile and at the end the whole, by channel.
using Side = std::vector<std::array<Estimate, 3>>;

/// Independent runs of independent pixels are one longer run.
Region mean_of_runs(const std::vector<Region>& runs) {
  Region sum;
  for (const Region& r : runs) sum += r;
  const double k = double(runs.size());
  sum.n /= k;
  sum.sum /= k;
  sum.squares /= k;
  sum.variance /= k * k;
  sum.variance_squares /= k * k * k * k;
  return sum;
}

Side side_of(const NoisyImage& picture, const std::vector<Tile>& tiles) {
  std::vector<Regions> runs;
  for (const Image* run : picture.runs) runs.push_back(regions_of(tiles, *run));
  Side side(tiles.size() + 1);
  for (std::size_t t = 0; t < side.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      std::vector<Region> here;
      for (const Regions& run : runs) here.push_back(run[t][c]);
      side[t][c] = picture.by_spread() ? by_spread(here, picture.samples)
                                       : by_pixels(mean_of_runs(here), picture);
    }
  return side;
}

/// Mean over channels.
double energy(const std::array<Estimate, 3>& channels) {
  double sum = 0;
  for (const Estimate& e : channels) sum += std::abs(e.mean) / 3;
  return sum;
}

/// Standard errors beyond the threshold that make a difference detectable.
double beyond_threshold(const ZTestLimits& limits) {
  return normal_quantile(limits.power);
}

MeanTest welch(const Estimate& a, const Estimate& b, double alpha, double beyond, double scale) {
  const double floor = ARITHMETIC * std::max(std::abs(a.mean), std::abs(b.mean));
  const double noise = a.variance + b.variance;
  const double error = std::sqrt(noise + floor * floor);
  constexpr double normal = 1e6;  // degrees of freedom from which Student's t is as good as that
  const double degrees = noise > 0 ? std::min(normal, noise * noise /
                                                          (a.variance * a.variance / a.degrees +
                                                           b.variance * b.variance / b.degrees))
                                   : normal;
  MeanTest test;
  test.z = quotient(a.mean - b.mean, error);
  test.threshold = -student_quantile(alpha / 2, degrees);
  test.difference = quotient(a.mean - b.mean, scale);
  test.detectable = quotient((test.threshold + beyond) * error, scale);
  return test;
}

/// The one that is nearer to its threshold, or farther beyond.
void keep_worst(const MeanTest& test, MeanTest& worst) {
  const auto excess = [](const MeanTest& t) { return std::abs(t.z) / t.threshold; };
  if (worst.threshold == 0 || excess(test) > excess(worst)) worst = test;
}

void judge_image(const Side& a, const Side& b, const Tile& whole, const ZTestLimits& limits,
                 ZTest& result) {
  result.image_events = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < 3; ++c) {
    const Estimate &of_a = a.back()[c], &of_b = b.back()[c];
    MeanTest test =
        welch(of_a, of_b, limits.alpha / 2 / 3, beyond_threshold(limits), energy(b.back()));
    test.channel = c;
    test.where = whole;
    keep_worst(test, result.image);
    result.detectable_image = std::max(result.detectable_image, test.detectable);
    result.image_events = std::min({result.image_events, of_a.events, of_b.events});
  }
}

void judge_tiles(const Side& a, const Side& b, const std::vector<Tile>& tiles, bool independent,
                 const ZTestLimits& limits, ZTest& result) {
  const double channel = limits.alpha / 2 / 3, count = double(tiles.size());
  const double level = independent ? -std::expm1(std::log1p(-channel) / count) : channel / count;
  const double beyond = beyond_threshold(limits);
  result.tiles = tiles.size();
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    bool judged = true;
    for (std::size_t c = 0; c < 3; ++c)
      judged = judged && std::min(a[t][c].events, b[t][c].events) >= limits.least_events;
    if (!judged) continue;
    ++result.tiles_judged;
    const double scale = std::max(energy(b.back()), energy(b[t]));
    for (std::size_t c = 0; c < 3; ++c) {
      MeanTest test = welch(a[t][c], b[t][c], level, beyond, scale);
      test.channel = c;
      test.where = tiles[t];
      keep_worst(test, result.tile);
      result.detectable_tile = std::max(result.detectable_tile, test.detectable);
    }
  }
}

void conclude(const ZTestLimits& limits, ZTest& r) {
  constexpr const char* channels[] = {"R", "G", "B"};
  const auto say = [&](Verdict verdict, std::string reason) {
    r.verdict = verdict;
    r.reason = std::move(reason);
  };
  if (r.image.differs())
    return say(Verdict::different,
               fmt::format("the picture's mean of {} is off by {:.3g} % of its energy",
                           channels[r.image.channel], 100 * r.image.difference));
  if (r.tiles_judged > 0 && r.tile.differs())
    return say(Verdict::different,
               fmt::format("the mean of {} in the tile at {},{} is off by {:.3g} % of its energy",
                           channels[r.tile.channel], r.tile.where.x0, r.tile.where.y0,
                           100 * r.tile.difference));
  if (!(r.image_events >= limits.least_events))
    return say(Verdict::inconclusive,
               fmt::format("only about {:.0f} samples matter; {:.0f} are needed", r.image_events,
                           limits.least_events));
  if (!(r.detectable_image <= limits.image))
    return say(Verdict::inconclusive,
               fmt::format("noise could hide {:.2g} % of the picture's energy; the limit is {:g} %",
                           100 * r.detectable_image, 100 * limits.image));
  if (2 * r.tiles_judged < r.tiles)
    return say(Verdict::inconclusive,
               fmt::format("{} of {} tiles have fewer than {:.0f} samples that matter",
                           r.tiles - r.tiles_judged, r.tiles, limits.least_events));
  if (!(r.detectable_tile <= limits.tile))
    return say(Verdict::inconclusive,
               fmt::format("noise could hide {:.2g} % of a tile's energy; the limit is {:g} %",
                           100 * r.detectable_tile, 100 * limits.tile));
  say(Verdict::equal, "no difference beyond what noise explains");
}

}  // namespace

const char* verdict_name(Verdict verdict) {
  return verdict == Verdict::equal       ? "EQUAL"
         : verdict == Verdict::different ? "DIFFERENT"
                                         : "INCONCLUSIVE";
}

ZTest z_test(const NoisyImage& a, const NoisyImage& b, const ZTestLimits& limits) {
  ZTest result;
  result.identical = true;
  for (const Image* run : a.runs) {
    const ImagePair pair(*run, *b.runs.front());
    for (std::size_t p = 0; p < pair.pixels() && result.identical; ++p)
      for (std::size_t c = 0; c < 3; ++c)
        result.identical = result.identical && pair.a(p, c) == pair.b(p, c);
  }
  const Image& image = *b.runs.front();
  const std::vector<Tile> tiles = tiles_of(image.width, image.height);
  const Side side_a = side_of(a, tiles), side_b = side_of(b, tiles);
  judge_image(side_a, side_b, {0, 0, image.width, image.height}, limits, result);
  judge_tiles(side_a, side_b, tiles, a.independent_pixels && b.independent_pixels, limits, result);
  conclude(limits, result);
  if (result.identical) {
    result.verdict = Verdict::equal;
    result.reason = "identical";
  }
  return result;
}

Image z_map(const Image& a, const Image& reference) {
  const ImagePair pair(a, reference);
  const Variances of_a(a), of_b(reference);
  Image map;
  map.width = a.width;
  map.height = a.height;
  map.channels = {"error"};
  for (std::size_t p = 0; p < pair.pixels(); ++p) {
    double difference = 0, deviation = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      difference += pair.a(p, c) - pair.b(p, c);
      // The same paths make all colours of a pixel: their deviations add up.
      deviation += std::sqrt(of_a(p, c) + of_b(p, c));
    }
    map.data.push_back(float(pair.finite(p) ? quotient(difference, deviation)
                                            : std::numeric_limits<double>::quiet_NaN()));
  }
  return map;
}

}  // namespace pellucid

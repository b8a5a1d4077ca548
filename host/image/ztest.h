// Do two noisy pictures show the same, and is the noise small enough to say so? A test by the
// variances that both pictures store, of every tile and of the whole.
#pragma once

#include <string>
#include <vector>

#include "image/image.h"
#include "image/image_pair.h"

namespace pellucid {

/// What one side shows: a picture with its variances, or runs of it that are independent of each
/// other.
struct NoisyImage {
  std::vector<const Image*> runs;
  double samples = 0;  ///< per pixel, of one run
  /// Whether the noise of one pixel tells nothing of its neighbours'. It does where light paths
  /// reach many pixels (splats), or many pixels share photons (merging).
  bool independent_pixels = false;
  bool by_spread() const { return runs.size() > 1 && !independent_pixels; }
};

struct ZTestLimits {
  double alpha = 1e-4;  ///< probability that equal pictures are called different
  double power = 0.95;  ///< probability that a difference called detectable is found
  /// Largest detectable difference that may remain: of the whole over its energy, the mean of
  /// pixels and channels; and of a tile over its energy or, where that is less, the whole's.
  double image = 0.005, tile = 0.05;
  double least_events = 300;  ///< samples that matter, below which means are not normal enough
};

enum class Verdict { equal, different, inconclusive };
const char* verdict_name(Verdict verdict);

/// The difference of the means of one region and channel.
struct MeanTest {
  double difference = 0;  ///< over the scale of its limit
  double z = 0;           ///< difference / its standard error
  double threshold = 0;   ///< largest |z| of equal pictures
  double detectable = 0;  ///< least difference that is found with `power`, over the same scale
  std::size_t channel = 0;
  Tile where{};
  bool differs() const { return !(std::abs(z) <= threshold); }
};

struct ZTest {
  Verdict verdict = Verdict::inconclusive;
  std::string reason;      ///< for people
  bool identical = false;  ///< bit for bit, so noise does not matter
  MeanTest image, tile;  ///< the channel, and the tile, nearest to or farthest beyond its threshold
  double detectable_image = 0;  ///< the largest of all channels
  double detectable_tile = 0;   ///< and of all judged tiles
  double image_events = 0;      ///< samples that matter, in the poorest channel and picture
  std::size_t tiles = 0, tiles_judged = 0;
};

/// Welch's test. Levels are shared half and half between the whole and the tiles, by Bonferroni
/// between channels, and by Sidak between tiles, or by Bonferroni where pixels depend on each
/// other. The variance of a region's mean is the sum of its pixels' where these are independent;
/// else the spread of the runs gives it, or for a single run the bound that holds for any
/// dependence. All images have R, G, B and known variances (image/variances.h; by_spread() does
/// without) and are finite. Throws InputError if sizes or channels differ.
ZTest z_test(const NoisyImage& a, const NoisyImage& reference, const ZTestLimits& limits = {});

/// One channel "error" per pixel: mean over colours of (a - b) over its standard error; NaN where
/// either image is not finite. The same conditions.
Image z_map(const Image& a, const Image& reference);

}  // namespace pellucid

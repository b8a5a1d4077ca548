// Error of one image against a reference. Non-finite values are counted first and never averaged.
#pragma once

#include <cstdint>

#include "image/image.h"
#include "image/image_pair.h"

namespace pellucid {

/// All errors are means over pixels and the R,G,B channels (or the one channel of grey images),
/// taken in double. Other channels (depth, variance, ...) are not looked at. e = 1 % of the mean of
/// the reference; 0/0 counts as no error, so a black image equals itself.
struct ImageError {
  std::uint64_t nonfinite =
      0;  ///< pixels with a NaN or Inf in either image; if > 0 the rest is NaN
  double mse = 0, rmse = 0;
  double relmse = 0;                   ///< mean (a-b)^2/(b^2+e^2)
  double trimmed_relmse = 0;           ///< without the largest 0.1 % of these terms
  double smape = 0;                    ///< mean 2|a-b|/(|a|+|b|+e)
  double energy_ratio = 0;             ///< sum a / sum b; 1 if both are 0
  std::vector<double> channel_energy;  ///< the same by channel
  double worst_channel_energy = 0;     ///< the one of these that is farthest from 1
  double p95_tile_relmse = 0;          ///< 95th percentile (nearest rank) of relMSE over tiles
  double worst_tile_relmse = 0;        ///< of the tile
  Tile worst_tile{};                   ///< that is farthest off
  double tiles_within_1pct = 0;        ///< share of tiles with a root of relMSE up to 0.01
  double firefly_index = 0;            ///< of a: maximum / 99.9th percentile of pixels
  double reference_firefly_index = 0;
};

/// Throws InputError if the sizes or colour channels differ.
ImageError compare_images(const Image& a, const Image& reference);

/// One channel "error" per pixel: the root of its relMSE, i.e. 0.01 is "1 % off". NaN where either
/// image is not finite. Throws as compare_images.
Image error_map(const Image& a, const Image& reference);
/// The same with a sign: mean over colours of (a-b)/sqrt(b^2+e^2), so noise of colours cancels.
Image signed_map(const Image& a, const Image& reference);

/// One channel on its own. Only finite values count for min, mean and max; NaN if there is none.
struct ChannelStatistics {
  double min = 0, mean = 0, max = 0;
  std::uint64_t nonfinite = 0;
};
ChannelStatistics channel_statistics(const Image& image, std::size_t channel);

}  // namespace pellucid

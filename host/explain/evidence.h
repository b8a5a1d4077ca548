// What two pictures tell of each other: radiance by path length in cells of the picture, and the
// noise of its differences.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "image/image.h"

namespace pellucid::explain {

constexpr std::size_t COLOURS = 3;

/// A picture pixel by pixel, with the layers by path length that it may have.
class Layered {
 public:
  /// Must not outlive the image. Throws InputError if it has no R, G and B.
  explicit Layered(const Image& image);

  const Image& image() const { return image_; }
  int width() const { return image_.width; }
  int height() const { return image_.height; }
  std::size_t pixels() const { return std::size_t(image_.width) * std::size_t(image_.height); }
  /// Layers, 0 or at least 2: of length 1, 2, ..., and the last of all that is longer.
  std::size_t layers() const { return lengths_.size(); }
  double at(std::size_t layer, std::size_t pixel, std::size_t c) const {
    return image_.data[pixel * image_.channels.size() + lengths_[layer][c]];
  }
  double all(std::size_t pixel, std::size_t c) const {
    return image_.data[pixel * image_.channels.size() + colours_[c]];
  }
  /// Whether the layers' energy is that of the picture, to a part in a thousand in every channel.
  bool adds_up() const;

 private:
  const Image& image_;
  std::array<std::size_t, COLOURS> colours_;
  std::vector<std::array<std::size_t, COLOURS>> lengths_;
};

/// Squares of pixels, at most 32 a side of the picture.
struct Grid {
  int width, height, side, columns, rows;
  Grid(int picture_width, int picture_height);
  std::size_t cells() const { return std::size_t(columns) * std::size_t(rows); }
  std::size_t cell(int x, int y) const {
    return std::size_t(y / side) * std::size_t(columns) + std::size_t(x / side);
  }
  std::size_t pixel(int x, int y) const {
    return std::size_t(y) * std::size_t(width) + std::size_t(x);
  }
};

/// Sums over the pixels of cells: [channel * cells + cell].
using Sums = std::vector<double>;
using Layers = std::vector<Sums>;

/// A range of channels.
struct Channels {
  std::size_t first = 0, last = COLOURS;
};

/// The two pictures, by path length as far as both tell it.
struct Evidence {
  Grid grid;
  Layers known;        ///< by length, the last of all that is longer
  Layers other;        ///< the same, or one: all lengths together
  Layers noise_known;  ///< variances, as `known`
  Layers noise_other;  ///< as `other`
  Layers tolerance;    ///< squares of what a right cause may leave, as `other`
  /// Cells along a side of what counts as one, by group: where a cell is mostly noise, its sum with
  /// others stands in the first one of them, and the others are 0.
  std::vector<int> block;

  std::size_t lengths() const { return known.size(); }
  bool by_length() const { return other.size() > 1; }
  std::size_t observations() const;
  std::size_t observations(std::size_t group) const;
  /// Cell of a pixel, or of the block it is in.
  std::size_t cell(std::size_t layer, int x, int y) const;
  /// Layers by length as `other` has them.
  Layers grouped(const Layers& layers) const;
  /// Of other - known in a group.
  double variance(std::size_t group, std::size_t j) const;
  /// How badly layers by length predict the other picture: sum of squares over variances. A layer
  /// that is f times the known one has f times its noise; so a noisy layer does not look like less
  /// light [Deming43]. `skipped`: cells that do not count in the first `direct` groups.
  double misfit(const Layers& predicted, Channels channels = {},
                const std::vector<char>& skipped = {}, std::size_t direct = 0) const;
};

/// `known` has layers, and both pictures are finite and of one size. `by_length`: take those of
/// `other`, too; where they are fewer or more, the longer lengths of both are put together.
///
/// Noise is what neighbouring pixels do not have in common once the one picture, times the ratio of
/// the cell, is taken off the other. So it is right for pictures of the same random numbers and of
/// any program, layer by layer, and what the pictures show is not taken for it. Where a filter or
/// light paths spread noise over neighbours, cells differ by more than pixels say: then the median
/// of the second differences of cells tells how much more.
Evidence gather(const Layered& known, const Layered& other, bool by_length);

/// Energy of a sum over the cells, by channel, and of all channels.
double energy(const Grid& grid, const Sums& sums, std::size_t c);
double energy(const Sums& sums);

}  // namespace pellucid::explain

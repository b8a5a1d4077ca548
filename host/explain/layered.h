// Pictures with layers by path length, pixel by pixel and in cells.
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

/// Layers first ... last - 1 of a picture together; none: the picture itself.
struct Part {
  const Layered& picture;
  std::size_t first, last;

  double at(std::size_t pixel, std::size_t c) const {
    if (first == last) return picture.all(pixel, c);
    double value = 0;
    for (std::size_t layer = first; layer < last; ++layer) value += picture.at(layer, pixel, c);
    return value;
  }
};

Sums cell_sums(const Grid& grid, const Part& part);

/// Energy of a sum over the cells, by channel, and of all channels.
double energy(const Grid& grid, const Sums& sums, std::size_t c);
double energy(const Sums& sums);

}  // namespace pellucid::explain

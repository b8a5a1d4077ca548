// The colours of two images of equal shape side by side, and the tiles in which errors are local.
#pragma once

#include <cmath>
#include <cstdint>

#include "image/image.h"

namespace pellucid {

/// Which channels hold colour: R, G, B, or the only one there is beside an alpha. Throws InputError
/// if neither is so.
std::vector<std::size_t> colour_channels(const Image& image);

/// error / scale, where no error is none on any scale.
inline double quotient(double error, double scale) {
  return error == 0.0 ? 0.0 : error / scale;
}

/// A rectangle of pixels, half-open.
struct Tile {
  int x0, y0, x1, y1;
  double pixels() const { return double(x1 - x0) * (y1 - y0); }
};
constexpr int TILE = 16;  ///< pixels a side, less at the right and the lower border
std::vector<Tile> tiles_of(int width, int height);

class ImagePair {
 public:
  /// Both must outlive this. Throws InputError if the sizes or colour channels differ.
  ImagePair(const Image& a, const Image& reference);

  int width() const { return a_.width; }
  int height() const { return a_.height; }
  std::size_t pixels() const { return std::size_t(a_.width) * std::size_t(a_.height); }
  std::size_t pixel(int x, int y) const {
    return std::size_t(y) * std::size_t(a_.width) + std::size_t(x);
  }
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
  /// Pixels with a NaN or Inf in either image.
  std::uint64_t count_nonfinite() const;
  /// e: 1 % of the mean of the reference, over the finite pixels. Relative to exposure, so exposure
  /// changes no ranking.
  double epsilon() const;
  /// Means over colours: relMSE of a pixel, and its signed difference on the same scale.
  double relmse(std::size_t pixel, double e) const;
  double signed_error(std::size_t pixel, double e) const;

 private:
  const Image &a_, &b_;
  std::vector<std::size_t> a_channels_, b_channels_;
};

}  // namespace pellucid

// What an image tells of its own noise: the channels variance.R/G/B, variances of the pixels'
// means.
#pragma once

#include <cmath>

#include "image/image.h"

namespace pellucid {

class Variances {
 public:
  /// Must not outlive the image.
  explicit Variances(const Image& image)
      : image_(image),
        channels_{image.channel("variance.R"), image.channel("variance.G"),
                  image.channel("variance.B")} {}

  bool stored() const { return channels_[0] >= 0 && channels_[1] >= 0 && channels_[2] >= 0; }
  /// Stored, and a number >= 0 everywhere: NaN says that there were too few passes to tell.
  bool known() const {
    if (!stored()) return false;
    const std::size_t pixels = std::size_t(image_.width) * std::size_t(image_.height);
    for (std::size_t p = 0; p < pixels; ++p)
      for (std::size_t c = 0; c < 3; ++c)
        if (!(operator()(p, c) >= 0) || std::isinf(operator()(p, c))) return false;
    return true;
  }
  double operator()(std::size_t pixel, std::size_t c) const {
    return image_.data[pixel * image_.channels.size() + std::size_t(channels_[c])];
  }

 private:
  const Image& image_;
  int channels_[3];
};

}  // namespace pellucid

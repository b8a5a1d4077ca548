// The black box: which single samples made a picture most wrong. The film remembers the brightest
// sample of every pixel and its pass, from which it can be traced again (render/replay.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/film.h"

namespace pellucid {

/// The brightest sample of a pixel.
struct Firefly {
  int x = 0, y = 0;  ///< of the whole picture
  std::uint64_t pass = 0;
  bool dropped = false;  ///< the film refused it: NaN, infinite or negative
  double luminance = 0;  ///< of the sample; NaN where it was dropped
  double others = 0;     ///< mean of the pixel's other samples; NaN where there are none
  double excess = 0;     ///< what it adds to the pixel's mean, over what the others make of it
};

/// Those that change their pixels most, relative to what the other samples make of them, strongest
/// first, at most `count`. Dark pixels count as a hundredth of the picture's mean, as in relMSE.
std::vector<Firefly> fireflies(const Film& film, std::size_t count);

}  // namespace pellucid

// Numbers as false colours beside each other, each with the scale that says what its colours mean.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "image/image.h"

namespace pellucid {

/// One picture of numbers >= 0.
struct HeatMap {
  std::string title;          ///< of the letters that the built-in font has
  std::vector<float> values;  ///< row by row
  /// Empty, or by pixel: 1 darkens, 2 lightens, so that neighbours of equal value can be told
  /// apart; 0: there is nothing.
  std::vector<float> parity;
};

/// Ends of a logarithmic scale, both of the series 1, 2, 5, 10, ...
struct HeatScale {
  double low, high;

  /// From 0 to 1; what is below or beyond is cut.
  float place(float value) const;
  /// Black for 0 alone: the lowest end is dark blue.
  std::array<float, 3> colour(float value) const;
  /// All of the series from low to high.
  std::vector<double> ticks() const;
};
/// The scale on which the values above 0 lie, all but the lowest and the highest hundredth.
HeatScale heat_scale(const std::vector<float>& values);

/// Display picture of numbers of this size, in false colours (image/tonemap.h) over their scales;
/// 0 is black. Pictures lie in a row or above each other, whichever is nearer to a square; small
/// ones grow by a whole number. Pure.
Image draw_heat_maps(int width, int height, const std::vector<HeatMap>& maps);

}  // namespace pellucid

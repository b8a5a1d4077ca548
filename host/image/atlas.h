// The pyramid of sampling strategies, after Veach: small pictures in rows by path length, each row
// with an exposure of its own, with labels.
#pragma once

#include <string>
#include <vector>

#include "image/image.h"

namespace pellucid {

/// What one strategy brings to the picture.
struct AtlasCell {
  bool weighted;           ///< which pyramid it belongs to
  int row, column;         ///< path length and s, from 0
  std::string label;       ///< over the picture; of the letters that the built-in font has
  std::vector<float> rgb;  ///< linear, row by row, three channels
};

/// Display picture of one pyramid, or, if some cells are unweighted, of two: side by side or above
/// each other, whichever is nearer to a square. `rows`: labels from the top. A row has one exposure
/// in both, in half stops, from what it has weighted. Cells are averaged down to at most 256
/// pixels; places without a cell stay dark. Pure.
Image draw_atlas(int width, int height, const std::vector<std::string>& rows,
                 const std::vector<AtlasCell>& cells);

/// Half stops that bring the brighter parts of a picture close to white: the 90th percentile of
/// the brightest channel of what is not black to 0.7. 0 for black ones.
double row_exposure(const std::vector<float>& rgb);

}  // namespace pellucid

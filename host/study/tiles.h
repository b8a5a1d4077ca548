// Pictures tile by tile: where a method is good, and whether two pictures agree everywhere.
#pragma once

#include <vector>

#include "study/picture_stack.h"

namespace pellucid {

/// How a picture of so many pixels is cut into tiles of STUDY_TILE, row by row.
struct Tiling {
  int width = 0, height = 0;

  int columns() const { return (width + STUDY_TILE - 1) / STUDY_TILE; }
  int rows() const { return (height + STUDY_TILE - 1) / STUDY_TILE; }
  int count() const { return columns() * rows(); }
  int of_pixel(int x, int y) const { return (y / STUDY_TILE) * columns() + x / STUDY_TILE; }
};

/// Mean of w (x - reference)^2 over the values of each tile and over the pictures.
std::vector<double> tile_errors(const Tiling& tiling, const PictureStack& stack,
                                const Picture& reference, const std::vector<double>& weights);

/// Sum of a picture's values, tile by tile.
std::vector<double> tile_energies(const Tiling& tiling, const Picture& picture);

/// The largest difference of two stacks' tiles in standard errors (Welch's t over the pictures of
/// each), and its probability by chance alone in any of the tiles: at most p times their number
/// (Bonferroni, since merged pictures are not independent from tile to tile). So much of the tile's
/// own light, and of a mean tile's, may differ beyond chance.
struct TileDifference {
  int tile = 0;
  double t = 0, probability = 1;
};
TileDifference worst_tile(const Tiling& tiling, const PictureStack& a, const PictureStack& b,
                          double allowed = 0);

}  // namespace pellucid

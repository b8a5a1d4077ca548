// What two pictures tell of each other: radiance by path length in cells of the picture, and the
// noise of its differences.
#pragma once

#include <vector>

#include "explain/layered.h"

namespace pellucid::explain {

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
  /// Cells, or blocks of them, of all groups or of one. The same paths make all channels, whose
  /// noise goes up and down together: they count as one.
  std::size_t observations() const;
  std::size_t observations(std::size_t group) const;
  /// Cell of a pixel, or of the block it is in.
  std::size_t cell(std::size_t layer, int x, int y) const;
  /// Layers by length as `other` has them.
  Layers grouped(const Layers& layers) const;
  /// Of other - known in a group.
  double variance(std::size_t group, std::size_t j) const;
  /// How badly layers by length predict the other picture: sum of squares over variances, mean of
  /// channels. A layer that is f times the known one has f times its noise; so a noisy layer does
  /// not look like less light [Deming43]. `skipped`: cells that do not count in the first `direct`
  /// groups.
  double misfit(const Layers& predicted, Channels channels = {},
                const std::vector<char>& skipped = {}, std::size_t direct = 0) const;
};

/// `known` has layers, and both pictures are finite and of one size. `by_length`: take those of
/// `other`, too; where they are fewer or more, the longer lengths of both are put together.
Evidence gather(const Layered& known, const Layered& other, bool by_length);

}  // namespace pellucid::explain

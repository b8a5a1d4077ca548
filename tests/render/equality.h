// EQ of accuracy.md 4: are two sets of independent runs means of the same pictures, and do we know
// well enough to say so?
#pragma once

#include <array>
#include <string>
#include <vector>

#include "render_harness.h"

namespace pellucid::test {

/// One number per run, independent of each other.
using Sample = std::vector<double>;

/// Mean of the runs, and the variance that their spread gives it.
Estimate estimate(const Sample& sample);

/// Welch's test and the power guard: "" if the means of a and b do not differ at level `alpha` and
/// the interval of their difference lies inside +-`within`; else the reason.
std::string welch(const Sample& a, const Sample& b, double alpha, double within);

/// What K runs of one method left: means of the whole picture and of its tiles, per channel.
struct Runs {
  explicit Runs(int tile_size) : tile(tile_size) {}
  int tile;                                        ///< side in pixels
  std::array<Sample, 3> image;                     ///< [channel][run]
  std::array<std::vector<Sample>, 3> tiles;        ///< [channel][tile][run]
  std::array<std::vector<double>, 3> effective{};  ///< [channel][tile], summed over runs

  void add(const Picture& picture);
};

/// Image and tiles, all channels. Both have the same tiles; Bonferroni over them, since pixels that
/// share light paths are not independent. A tile in which fewer than 300 samples
/// matter on either side is not judged alone (its t-test would flake low); if that is so for more
/// than half of the tiles the verdict is INCONCLUSIVE.
std::vector<std::string> compare_runs(const Runs& a, const Runs& b, double alpha);

}  // namespace pellucid::test

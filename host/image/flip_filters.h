// The filters of FLIP: what an eye blurs, and the edges and points it looks for.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace pellucid::flip {

/// Weights at -radius ... radius.
using Kernel = std::vector<double>;

/// Rows of one value each; `rim` further ones above and below. Beyond its sides a row goes on as it
/// ends.
struct Band {
  int width = 0, rows = 0, rim = 0;
  std::vector<double> values;
};

/// The values of the rows without rim, filtered along x by the one kernel and along y by the other.
std::vector<double> filtered(const Band& band, const Kernel& along_x, const Kernel& along_y);

/// Contrast sensitivity of the channels Y, Cx (red-green), Cz (blue-yellow) [Andersson20, 4.1.1].
class SpatialFilter {
 public:
  explicit SpatialFilter(double ppd);
  int radius() const { return radius_; }
  std::vector<double> apply(const Band& band, std::size_t channel) const;
  /// Weight of the pixel at (x, y).
  double at(std::size_t channel, int x, int y) const;

 private:
  struct Term {
    double weight;
    Kernel kernel;  ///< sums to 1
  };
  int radius_;
  std::array<std::vector<Term>, 3> terms_;
};

/// Derivatives of a Gaussian, both ways [Andersson20, 4.2].
class FeatureFilter {
 public:
  explicit FeatureFilter(double ppd);
  int radius() const { return radius_; }
  std::vector<double> edges(const Band& luminance) const;
  std::vector<double> points(const Band& luminance) const;
  const Kernel& smooth() const { return smooth_; }
  const Kernel& edge() const { return edge_; }
  const Kernel& point() const { return point_; }

 private:
  std::vector<double> magnitude(const Band& band, const Kernel& derivative) const;
  int radius_;
  Kernel smooth_, edge_, point_;
};

}  // namespace pellucid::flip

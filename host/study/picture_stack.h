// Pictures of the same scene by runs of the same kind: their mean, their spread, and how far they
// are from a reference. A picture is R, G, B of all pixels in a row.
#pragma once

#include <functional>
#include <vector>

#include "study/study.h"

namespace pellucid {

using Picture = std::vector<float>;

/// Of relMSE: 1 / (reference^2 + e^2), e 1 % of the reference's mean; a black reference weighs
/// nothing, as nothing is relative to it.
std::vector<double> relmse_weights(const Picture& reference);

/// Mean of w (a - b)^2.
double weighted_distance(const Picture& a, const Picture& b, const std::vector<double>& weights);

/// Sum over all values, in double.
double energy_of(const Picture& picture);
bool all_finite(const Picture& picture);

class PictureStack {
 public:
  void add(Picture picture) { pictures_.push_back(std::move(picture)); }
  const std::vector<Picture>& pictures() const { return pictures_; }
  int size() const { return int(pictures_.size()); }

  Picture mean() const;
  /// Mean of w s^2, s^2 the unbiased variance of a value over the pictures; needs two of them.
  double variance(const std::vector<double>& weights) const;
  /// relMSE of one of them against `reference`, split into what their spread and what their mean
  /// has of it (accuracy.md 2); `reference_relmse` is the reference's own variance. Needs three.
  Split split(const Picture& reference, const std::vector<double>& weights,
              double reference_relmse) const;

 private:
  std::vector<Picture> pictures_;
};

}  // namespace pellucid

// Curves of error over time, and when they reach a target.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "study/study.h"

namespace pellucid {

/// The mean of all runs after so many seconds.
struct CurvePoint {
  double seconds = 0, relmse = 0;
};

/// Means over the runs, rung by rung, as far as all of them have come; without run number `leave`,
/// if that is one.
std::vector<CurvePoint> mean_curve(const std::vector<StudyRun>& runs, int leave = -1);

/// relMSE = noise t^-exponent + bias t^-bias_exponent, no coefficient below 0.
struct CurveFit {
  double noise = 0, exponent = 1, bias = 0, bias_exponent = 1;
  double residual = 0;  ///< largest |measured / fitted - 1|

  double at(double seconds) const;
  /// When it comes down to `relmse`; none where it is 0 throughout.
  std::optional<double> reaches(double relmse) const;
};

/// Unbiased methods: noise falls as 1 / t. Merging ones: what they connect does, too, what they
/// merge as t^-alpha, and the square of their bias as t^-(2 - 2 alpha) (accuracy.md 3); of the two
/// laws of noise the one that fits better. Errors count relative to the fitted value, so no rung
/// rules the others.
CurveFit fit_curve(const std::vector<CurvePoint>& curve, bool merges, double radius_alpha);

/// Slope of log relMSE over log seconds by least squares over all rungs above 0; none below two.
std::optional<double> curve_slope(const std::vector<CurvePoint>& curve);

/// A squared bias if it is there at 99.9 %, else 0; `upper90` is its one-sided bound over so many
/// runs.
double certain_bias(double bias2, double upper90, int runs);

/// An estimate and its standard error over the runs, by the jackknife.
struct Jackknife {
  double value = 0, error = 0;
};
/// `estimate(leave)`: from all runs but that one, -1: from all. None where one of them is none.
std::optional<Jackknife> jackknife(int runs,
                                   const std::function<std::optional<double>(int)>& estimate);

}  // namespace pellucid

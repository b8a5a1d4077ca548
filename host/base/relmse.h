// The weights of relMSE, the error that everything here is judged by (accuracy.md 2).
#pragma once

namespace pellucid {

/// e of relMSE in means of the reference: relative, so that exposure changes no rank.
constexpr double RELMSE_EPSILON = 0.01;

/// 1 / (reference^2 + e^2) for e in units of the reference; 0 where both are 0, as nothing is
/// relative to black.
inline double relmse_weight(double reference, double e) {
  const double square = reference * reference + e * e;
  return square > 0 ? 1 / square : 0;
}

}  // namespace pellucid

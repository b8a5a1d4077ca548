// Statistics of the sampling tests (accuracy.md section 4): chi-square with pooled cells, z-tests,
// Sidak's correction, and adaptive quadrature in double for what is expected.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>
#include "stability/quadrature.h"

namespace pellucid::test {

/// Probability that a chosen family of tests fails although the code is right: seeds are fixed, so
/// this only says how unlucky the choice of seed may be.
constexpr double family_alpha = 1e-4;

/// Level of each of `tests` independent tests that keeps the family at `alpha`.
double sidak(double alpha, int tests);

/// Upper incomplete gamma function, regularised: Q(a, x).
double gamma_q(double a, double x);

struct ChiSquare {
  double statistic = 0.0;
  int degrees = 0;
  double p_value = 1.0;
  double in_empty_cells = 0.0;  ///< samples where none may fall
  std::string describe() const;
};
/// Pearson's test of counts against expected counts (the same total; what the caller cannot place
/// gets a cell of its own). Cells are pooled in order of expectation until each expects 5.
ChiSquare chi_square(const std::vector<double>& observed, const std::vector<double>& expected);
/// The counts may come from the expectations at level `alpha`.
bool accepted(const ChiSquare& test, double alpha);

/// Mean and variance of a stream of numbers [Welford62].
struct Moments {
  std::uint64_t n = 0;
  double mean = 0.0, m2 = 0.0;
  void add(double x) {
    ++n;
    const double d = x - mean;
    mean += d / double(n);
    m2 += d * (x - mean);
  }
  double standard_error() const;
};
/// Two-sided p-value of the mean against `expected`; `slack` is the error of `expected` itself.
double z_test(const Moments& m, double expected, double slack);

using stability::integrate;

/// Polar cells around an axis, finer near it: ring r = t/(1-t) in units of `width`, r =
/// tan(angle/2)/width. Narrow lobes fill as many cells as wide ones.
class LobeGrid {
 public:
  LobeGrid(const glm::dvec3& axis, double width, int rings = 20, int sectors = 24);
  int cells() const { return rings_ * sectors_; }
  int cell(const glm::dvec3& direction) const;
  /// Integral of `density` [1/sr] over each cell.
  std::vector<double> integrate_cells(const std::function<double(const glm::dvec3&)>& density,
                                      double tolerance) const;
  /// Integral over the whole sphere.
  double integral(const std::function<double(const glm::dvec3&)>& density, double tolerance) const;

 private:
  glm::dvec3 s_, t_, n_;
  double width_;
  int rings_, sectors_;
};

}  // namespace pellucid::test

// Least squares without negative coefficients, crossings by bisection, and the jackknife.
#include "study/fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/statistics.h"

namespace pellucid {
namespace {

/// Minimises sum w (m - a x - b y)^2 over a, b >= 0: one of the four cases of who is 0.
std::array<double, 2> least_squares(const std::vector<std::array<double, 3>>& xym,
                                    const std::vector<double>& w) {
  double xx = 0, xy = 0, yy = 0, xm = 0, ym = 0;
  for (std::size_t i = 0; i < xym.size(); ++i) {
    const auto& [x, y, m] = xym[i];
    xx += w[i] * x * x, xy += w[i] * x * y, yy += w[i] * y * y;
    xm += w[i] * x * m, ym += w[i] * y * m;
  }
  const double det = xx * yy - xy * xy;
  // Relative: two rungs at the same time, or equal exponents, tell the terms not apart.
  if (det > 1e-12 * xx * yy) {
    const double a = (xm * yy - ym * xy) / det, b = (ym * xx - xm * xy) / det;
    if (a >= 0 && b >= 0) return {a, b};
  }
  const double a = xx > 0 ? std::max(0.0, xm / xx) : 0, b = yy > 0 ? std::max(0.0, ym / yy) : 0;
  // What is left of the error falls by xm^2 / xx or ym^2 / yy.
  return b == 0 || (yy > 0 && xx > 0 && xm * xm * yy >= ym * ym * xx) ? std::array{a, 0.0}
                                                                      : std::array{0.0, b};
}

CurveFit fit_terms(const std::vector<CurvePoint>& curve, double exponent, double bias_exponent,
                   bool with_bias) {
  CurveFit fit;
  fit.exponent = exponent, fit.bias_exponent = bias_exponent;
  std::vector<std::array<double, 3>> xym;
  double scale = 0;
  for (const CurvePoint& p : curve) {
    const double x = std::pow(p.seconds, -exponent);
    xym.push_back({x, with_bias ? std::pow(p.seconds, -bias_exponent) : 0.0, p.relmse});
    scale += p.relmse / x / double(curve.size());
  }
  if (!(scale > 0)) return fit;
  fit.noise = scale;
  constexpr int rounds = 20;  // weights of the fit before settle long before that
  for (int i = 0; i < rounds; ++i) {
    std::vector<double> w;
    for (const CurvePoint& p : curve) w.push_back(1 / std::pow(fit.at(p.seconds), 2));
    const auto [a, b] = least_squares(xym, w);
    if (a == 0 && b == 0) break;
    fit.noise = a, fit.bias = b;
  }
  for (const CurvePoint& p : curve)
    fit.residual = std::max(fit.residual, std::abs(p.relmse / fit.at(p.seconds) - 1));
  return fit;
}

}  // namespace

std::vector<CurvePoint> mean_curve(const std::vector<StudyRun>& runs, int leave) {
  std::vector<CurvePoint> curve;
  std::size_t rungs = runs.empty() ? 0 : std::numeric_limits<std::size_t>::max();
  for (const StudyRun& run : runs) rungs = std::min(rungs, run.rungs.size());
  const double n = double(runs.size()) - (leave >= 0 ? 1 : 0);
  for (std::size_t r = 0; r < rungs; ++r) {
    CurvePoint p;
    for (int k = 0; k < int(runs.size()); ++k) {
      if (k == leave) continue;
      p.seconds += runs[std::size_t(k)].rungs[r].seconds / n;
      p.relmse += runs[std::size_t(k)].rungs[r].relmse / n;
    }
    curve.push_back(p);
  }
  return curve;
}

double CurveFit::at(double seconds) const {
  return noise * std::pow(seconds, -exponent) + bias * std::pow(seconds, -bias_exponent);
}

std::optional<double> CurveFit::reaches(double relmse) const {
  if (!(relmse > 0) || !(noise > 0 || bias > 0)) return std::nullopt;
  double low = -60, high = 60;  // log seconds
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (at(std::exp(middle)) > relmse ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

CurveFit fit_curve(const std::vector<CurvePoint>& curve, bool merges, double radius_alpha) {
  if (!merges) return fit_terms(curve, 1, 1, false);
  const double of_bias = 2 - 2 * radius_alpha;
  const CurveFit one = fit_terms(curve, 1, of_bias, true);
  const CurveFit slow = fit_terms(curve, radius_alpha, of_bias, true);
  return slow.residual < one.residual ? slow : one;
}

std::optional<double> curve_slope(const std::vector<CurvePoint>& curve) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const CurvePoint& p : curve) {
    if (!(p.relmse > 0 && p.seconds > 0)) continue;
    const double u = std::log(p.seconds), v = std::log(p.relmse);
    n += 1, x += u, y += v, xx += u * u, xy += u * v;
  }
  const double det = n * xx - x * x;
  if (n < 2 || !(det > 0)) return std::nullopt;
  return (n * xy - x * y) / det;
}

double certain_bias(double bias2, double upper90, int runs) {
  constexpr double sure = 0.999, bound = 0.9;
  if (runs < 2 || !std::isfinite(bias2)) return 0;
  const double error = (upper90 - bias2) / student_quantile(bound, double(runs - 1));
  return bias2 > student_quantile(sure, double(runs - 1)) * error ? bias2 : 0;
}

std::optional<Jackknife> jackknife(int runs,
                                   const std::function<std::optional<double>(int)>& estimate) {
  const std::optional<double> all = estimate(-1);
  if (!all || runs < 2) return std::nullopt;
  std::vector<double> parts;
  double mean = 0, squares = 0;
  for (int k = 0; k < runs; ++k) {
    const std::optional<double> part = estimate(k);
    if (!part) return std::nullopt;
    parts.push_back(*part);
    mean += *part / runs;
  }
  for (double part : parts) squares += (part - mean) * (part - mean);
  return Jackknife{*all, std::sqrt(squares * (runs - 1) / runs)};
}

}  // namespace pellucid

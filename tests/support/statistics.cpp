// Chi-square, z-test and lobes in cells.
#include "support/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pellucid::test {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double least_expected = 5.0;

using Function2 = std::function<double(double, double)>;

/// Series for x < a + 1.
double gamma_p_series(double a, double x) {
  double term = 1.0 / a, sum = term;
  for (int n = 1; n < 10000 && std::abs(term) > std::abs(sum) * 1e-15; ++n) {
    term *= x / (a + n);
    sum += term;
  }
  return sum * std::exp(-x + a * std::log(x) - std::lgamma(a));
}

/// Continued fraction (Lentz) for x >= a + 1.
double gamma_q_fraction(double a, double x) {
  const double tiny = 1e-300;
  double b = x + 1.0 - a, c = 1.0 / tiny, d = 1.0 / b, h = d;
  for (int i = 1; i < 10000; ++i) {
    const double an = -i * (i - a);
    b += 2.0;
    d = an * d + b;
    d = 1.0 / (std::abs(d) < tiny ? tiny : d);
    c = b + an / c;
    if (std::abs(c) < tiny) c = tiny;
    h *= d * c;
    if (std::abs(d * c - 1.0) < 1e-15) break;
  }
  return std::exp(-x + a * std::log(x) - std::lgamma(a)) * h;
}

}  // namespace

double sidak(double alpha, int tests) {
  return -std::expm1(std::log1p(-alpha) / tests);
}

double gamma_q(double a, double x) {
  if (x <= 0.0) return 1.0;
  return x < a + 1.0 ? 1.0 - gamma_p_series(a, x) : gamma_q_fraction(a, x);
}

std::string ChiSquare::describe() const {
  return "chi2 " + std::to_string(statistic) + " with " + std::to_string(degrees) +
         " degrees, log10 p " + std::to_string(std::log10(std::max(p_value, 1e-300))) + ", " +
         std::to_string(in_empty_cells) + " samples in empty cells";
}

ChiSquare chi_square(const std::vector<double>& observed, const std::vector<double>& expected) {
  std::vector<size_t> order(expected.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(),
            [&](size_t a, size_t b) { return expected[a] < expected[b]; });
  ChiSquare result;
  double pooled_observed = 0.0, pooled_expected = 0.0;
  int cells = 0;
  for (size_t i : order) {
    if (expected[i] <= 0.0) {
      result.in_empty_cells += observed[i];
      continue;
    }
    pooled_observed += observed[i];
    pooled_expected += expected[i];
    if (pooled_expected < least_expected) continue;
    const double d = pooled_observed - pooled_expected;
    result.statistic += d * d / pooled_expected;
    pooled_observed = pooled_expected = 0.0;
    ++cells;
  }
  // What is left (only if everything together expects less than 5) carries no information.
  result.degrees = std::max(cells - 1, 0);
  if (result.degrees > 0) result.p_value = gamma_q(0.5 * result.degrees, 0.5 * result.statistic);
  return result;
}

bool accepted(const ChiSquare& test, double alpha) {
  return test.in_empty_cells == 0.0 && test.degrees > 0 && test.p_value > alpha;
}

double Moments::standard_error() const {
  return n < 2 ? 0.0 : std::sqrt(m2 / (double(n) - 1.0) / double(n));
}

double z_test(const Moments& m, double expected, double slack) {
  const double difference = std::max(0.0, std::abs(m.mean - expected) - slack);
  if (difference == 0.0) return 1.0;
  const double se = m.standard_error();
  return se > 0.0 ? std::erfc(difference / se / std::sqrt(2.0)) : 0.0;
}

LobeGrid::LobeGrid(const glm::dvec3& axis, double width, int rings, int sectors)
    : n_(glm::normalize(axis)), width_(width), rings_(rings), sectors_(sectors) {
  const glm::dvec3 helper = std::abs(n_.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  s_ = glm::normalize(glm::cross(helper, n_));
  t_ = glm::cross(n_, s_);
}

int LobeGrid::cell(const glm::dvec3& w) const {
  const double x = glm::dot(w, s_), y = glm::dot(w, t_), z = glm::dot(w, n_);
  // tan(angle/2) = sin / (1 + cos), or (1 - cos) / sin on the other half
  const double sine = std::hypot(x, y);
  const double tangent = z >= 0 ? sine / (1 + z) : (1 - z) / std::max(sine, 1e-300);
  const double ring = tangent / (width_ + tangent);
  const double sector = (std::atan2(y, x) + pi) / (2 * pi);
  const int i = std::min(int(ring * rings_), rings_ - 1);
  const int j = std::min(int(sector * sectors_), sectors_ - 1);
  return i * sectors_ + j;
}

std::vector<double> LobeGrid::integrate_cells(
    const std::function<double(const glm::dvec3&)>& density, double tolerance) const {
  const Function2 f = [&](double ring, double phi) {
    const double tangent = width_ * ring / (1 - ring);
    const double square = tangent * tangent;
    const double sine = 2 * tangent / (1 + square), cosine = (1 - square) / (1 + square);
    const double dangle = 2 / (1 + square) * width_ / ((1 - ring) * (1 - ring));
    const glm::dvec3 w = sine * (std::cos(phi) * s_ + std::sin(phi) * t_) + cosine * n_;
    return density(w) * sine * dangle;
  };
  std::vector<double> result;
  for (int i = 0; i < rings_; ++i)
    for (int j = 0; j < sectors_; ++j)
      result.push_back(integrate(f, double(i) / rings_, double(i + 1) / rings_,
                                 2 * pi * j / sectors_ - pi, 2 * pi * (j + 1) / sectors_ - pi,
                                 tolerance));
  return result;
}

double LobeGrid::integral(const std::function<double(const glm::dvec3&)>& density,
                          double tolerance) const {
  const std::vector<double> cells = integrate_cells(density, tolerance);
  return std::accumulate(cells.begin(), cells.end(), 0.0);
}

}  // namespace pellucid::test

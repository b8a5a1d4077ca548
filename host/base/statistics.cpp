// Distributions: the error function, the incomplete beta function, and inverses by bisection.
#include "base/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/error.h"

namespace pellucid {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// The continued fraction of the incomplete beta function, by Lentz's method [DLMF 8.17.22].
double beta_fraction(double x, double a, double b) {
  constexpr double tiny = 1e-300;
  constexpr int most = 10000;  // it needs about sqrt(max(a, b)) terms
  const auto away = [](double v) { return std::abs(v) < tiny ? tiny : v; };
  double c = 1, d = 1 / away(1 - (a + b) * x / (a + 1)), f = d;
  for (int m = 1; m < most; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    double step = 1;
    for (double term : {even, odd}) {
      d = 1 / away(1 + term * d);
      c = away(1 + term / c);
      step = c * d;
      f *= step;
    }
    if (std::abs(step - 1) < 4 * eps) return f;
  }
  return f;
}

/// I_x(a, b), regularised; the fraction converges quickly on the side of x that is chosen here.
double incomplete_beta(double x, double a, double b) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  if (x > (a + 1) / (a + b + 2)) return 1 - incomplete_beta(1 - x, b, a);
  const double front =
      std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x);
  return std::exp(front) * beta_fraction(x, a, b) / a;
}

/// Where a rising function reaches p, by bisection to the last bit.
template <typename F>
double inverse(F&& cdf, double p) {
  PELLUCID_CHECK(p > 0 && p < 1, "a probability between 0 and 1");
  double low = -1, high = 1;
  while (cdf(low) > p) low *= 2;
  while (cdf(high) < p) high *= 2;
  for (;;) {
    const double middle = low + 0.5 * (high - low);
    if (middle <= low || middle >= high) return middle;
    (cdf(middle) < p ? low : high) = middle;
  }
}

}  // namespace

double normal_cdf(double z) {
  return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

double normal_quantile(double p) {
  return p > 0.5 ? -normal_quantile(1 - p) : inverse(normal_cdf, p);
}

double student_cdf(double t, double dof) {
  const double tail = 0.5 * incomplete_beta(dof / (dof + t * t), 0.5 * dof, 0.5);
  return t > 0 ? 1 - tail : tail;
}

double student_quantile(double p, double dof) {
  if (p > 0.5) return -student_quantile(1 - p, dof);  // the lower tail has all its digits
  return inverse([&](double t) { return student_cdf(t, dof); }, p);
}

double median_of(std::vector<double> values) {
  PELLUCID_CHECK(!values.empty(), "a median of something");
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

}  // namespace pellucid

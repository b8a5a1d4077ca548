// Gauss-Jordan elimination of equations scaled to a diagonal of ones.
#include "explain/least_squares.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pellucid::explain {
namespace {

/// Part of an unknown's own column that the others must leave of it: double has 2^-53, which sums
/// of products of a thousand cells bring down to some 2^-40.
constexpr double LEAST_PIVOT = 0x1p-36;

/// Inverse of a symmetric matrix with ones on its diagonal; rows that depend on others are zero.
std::vector<double> inverse(std::vector<double> m, std::size_t n) {
  std::vector<double> inv(n * n);
  std::vector<char> lost(n);
  for (std::size_t i = 0; i < n; ++i) inv[i * n + i] = 1;
  for (std::size_t k = 0; k < n; ++k) {
    if (!(m[k * n + k] > LEAST_PIVOT)) {
      lost[k] = 1;
      continue;
    }
    const double scale = 1 / m[k * n + k];
    for (std::size_t j = 0; j < n; ++j) m[k * n + j] *= scale, inv[k * n + j] *= scale;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const double factor = m[i * n + k];
      for (std::size_t j = 0; j < n; ++j)
        m[i * n + j] -= factor * m[k * n + j], inv[i * n + j] -= factor * inv[k * n + j];
    }
  }
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j < n && lost[k]; ++j) inv[k * n + j] = inv[j * n + k] = 0;
  return inv;
}

}  // namespace

void LeastSquares::add(const std::vector<double>& x, double y, double weight,
                       const std::vector<double>& noise) {
  for (std::size_t i = 0; i < n_; ++i) {
    right_[i] += weight * x[i] * y;
    if (!noise.empty()) matrix_[i * n_ + i] -= weight * noise[i];
    for (std::size_t j = 0; j < n_; ++j) matrix_[i * n_ + j] += weight * x[i] * x[j];
  }
}

LeastSquares::Solution LeastSquares::solve_for(const std::vector<std::size_t>& free) const {
  const std::size_t n = free.size();
  std::vector<double> scale(n), m(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    const double own = matrix_[free[i] * n_ + free[i]];
    scale[i] = own > 0 ? 1 / std::sqrt(own) : 0;
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      m[i * n + j] = matrix_[free[i] * n_ + free[j]] * scale[i] * scale[j];
  const std::vector<double> inv = inverse(std::move(m), n);
  Solution s{std::vector<double>(n_),
             std::vector<double>(n_, std::numeric_limits<double>::infinity())};
  for (std::size_t i = 0; i < n; ++i) {
    if (!(inv[i * n + i] > 0)) continue;
    s.error[free[i]] = std::sqrt(inv[i * n + i]) * scale[i];
    for (std::size_t j = 0; j < n; ++j)
      s.value[free[i]] += inv[i * n + j] * scale[i] * scale[j] * right_[free[j]];
  }
  return s;
}

LeastSquares::Solution LeastSquares::solve() const {
  std::vector<std::size_t> all(n_);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return solve_for(all);
}

LeastSquares::Solution LeastSquares::solve_non_negative() const {
  std::vector<std::size_t> free;
  Solution s = solve_for(free);
  // Each round frees the unknown that gains most, and holds again what then wants to be negative;
  // it ends since the sum of squares falls. The bound is for sums that rounding keeps from falling.
  for (std::size_t round = 0; round < 3 * n_; ++round) {
    std::size_t best = n_;
    double most = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      const double own = matrix_[i * n_ + i];
      if (!(own > 0) || std::find(free.begin(), free.end(), i) != free.end()) continue;
      double slope = right_[i];
      for (std::size_t j = 0; j < n_; ++j) slope -= matrix_[i * n_ + j] * s.value[j];
      if (slope / std::sqrt(own) > most) most = slope / std::sqrt(own), best = i;
    }
    if (best == n_) break;
    free.push_back(best);
    for (s = solve_for(free);; s = solve_for(free)) {
      const auto worst =
          std::min_element(free.begin(), free.end(),
                           [&](std::size_t a, std::size_t b) { return s.value[a] < s.value[b]; });
      if (worst == free.end() || s.value[*worst] >= 0) break;
      free.erase(worst);
    }
  }
  for (std::size_t i = 0; i < n_; ++i) {
    if (std::find(free.begin(), free.end(), i) != free.end()) continue;
    std::vector<std::size_t> with = free;
    with.push_back(i);
    s.error[i] = solve_for(with).error[i];
  }
  return s;
}

Factor least(const std::function<double(double)>& misfit, double low, double high) {
  // Golden sections: what is left of the range after so many is what double can tell of a minimum.
  constexpr int sections = 45;
  const double golden = (std::sqrt(5.0) - 1) / 2, range = high - low;
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double at_a = misfit(a), at_b = misfit(b);
  for (int i = 0; i < sections; ++i) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      a = high - golden * (high - low), at_a = misfit(a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + golden * (high - low), at_b = misfit(b);
    }
  }
  Factor f;
  f.value = (low + high) / 2;
  // The sum of squares rises by 1 within a standard error.
  const double step = range * 0x1p-12;
  const double bend =
      (misfit(f.value + step) + misfit(f.value - step) - 2 * misfit(f.value)) / (step * step);
  if (bend > 0) f.error = std::sqrt(2 / bend);
  return f;
}

}  // namespace pellucid::explain

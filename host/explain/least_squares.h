// Least squares with few unknowns, free or not below zero, by normal equations.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

namespace pellucid::explain {

class LeastSquares {
 public:
  explicit LeastSquares(std::size_t unknowns)
      : n_(unknowns), matrix_(unknowns * unknowns), right_(unknowns) {}

  /// One observation: y = sum of x[i] * unknown[i], with the weight 1 / variance. `noise`:
  /// variances of x, taken off the squares, which noise makes larger (and so unknowns smaller)
  /// [Fuller87].
  void add(const std::vector<double>& x, double y, double weight,
           const std::vector<double>& noise = {});

  struct Solution {
    std::vector<double> value;
    std::vector<double> error;  ///< standard; infinite (and the value 0) where nothing tells it
  };
  Solution solve() const;
  /// The best solution without negative values [Lawson74]; the error of what is held at 0 is as if
  /// it alone were free beside the others.
  Solution solve_non_negative() const;

 private:
  Solution solve_for(const std::vector<std::size_t>& free) const;
  std::size_t n_;
  std::vector<double> matrix_, right_;
};

struct Factor {
  double value = 1, error = std::numeric_limits<double>::infinity();  ///< nothing tells it
};
/// Where a sum of squares over variances is least, from low to high, if it has one valley there.
Factor least(const std::function<double(double)>& misfit, double low, double high);

}  // namespace pellucid::explain

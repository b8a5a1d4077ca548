// Least squares: free, not negative, of noisy regressors, and of one unknown.
#include "explain/least_squares.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace pellucid::explain {
namespace {

TEST(LeastSquares, finds_what_made_the_observations) {
  LeastSquares fit(3);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 4000; ++i) {
    const std::vector<double> x{1 + normal(random), 1 + normal(random), 1 + normal(random)};
    fit.add(x, 2 * x[0] - x[1] + 0.5 * x[2] + 0.1 * normal(random), 100);
  }
  const LeastSquares::Solution s = fit.solve();
  const double truth[] = {2, -1, 0.5};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(s.value[i], truth[i], 4 * s.error[i]);
    EXPECT_NEAR(s.error[i], 0.1 / std::sqrt(4000), 0.001);  // columns of variance 1 about the mean
  }
}

TEST(LeastSquares, nothing_negative_and_the_best_of_that) {
  LeastSquares fit(2);
  for (int i = 0; i < 10; ++i) fit.add({double(i), 1}, 3 * i - 2, 1);
  EXPECT_NEAR(fit.solve().value[1], -2, 1e-9);
  const LeastSquares::Solution s = fit.solve_non_negative();
  EXPECT_EQ(s.value[1], 0);
  // sum x (3 x - 2) / sum x^2 = 3 - 2 * 45 / 285
  EXPECT_NEAR(s.value[0], 3 - 90.0 / 285, 1e-12);
  EXPECT_TRUE(std::isfinite(s.error[1]));
}

TEST(LeastSquares, columns_that_cannot_be_told_apart_have_no_error) {
  LeastSquares fit(2);
  for (int i = 1; i < 10; ++i) fit.add({double(i), 2.0 * i}, 6.0 * i, 1);
  const LeastSquares::Solution s = fit.solve();
  EXPECT_TRUE(std::isinf(s.error[0]) || std::isinf(s.error[1]));
  EXPECT_NEAR(s.value[0] + 2 * s.value[1], 6, 1e-9);
  EXPECT_TRUE(std::isinf(LeastSquares(1).solve().error[0])) << "without observations";
}

TEST(LeastSquares, noise_of_regressors_makes_no_factor_smaller) {
  LeastSquares plain(1), corrected(1);
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20000; ++i) {
    const double truth = 1 + normal(random), x = truth + 0.5 * normal(random);
    plain.add({x}, 3 * truth, 1);
    corrected.add({x}, 3 * truth, 1, {0.25});
  }
  EXPECT_NEAR(plain.solve().value[0], 3 * 2 / 2.25, 0.03);
  EXPECT_NEAR(corrected.solve().value[0], 3, 0.03);
}

TEST(LeastSquares, one_unknown_by_search) {
  const Factor f = least([](double x) { return 7 + std::pow((x - 1.25) / 0.01, 2); }, 0, 4);
  EXPECT_NEAR(f.value, 1.25, 1e-6);
  EXPECT_NEAR(f.error, 0.01, 1e-4);
  EXPECT_NEAR(least([](double x) { return x; }, 0, 4).value, 0, 1e-6) << "at the border";
}

}  // namespace
}  // namespace pellucid::explain

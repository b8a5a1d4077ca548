// Quantiles against printed tables, and against their own inverse.
#include "base/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pellucid {
namespace {

TEST(Statistics, normal_tables) {
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-14);
  EXPECT_NEAR(normal_quantile(0.95), 1.644853626951473, 1e-14);
  EXPECT_NEAR(normal_quantile(1e-9), -5.997807015007687, 1e-12);
  EXPECT_NEAR(normal_cdf(-3), 0.0013498980316300946, 1e-17);
  EXPECT_EQ(normal_cdf(0), 0.5);
}

TEST(Statistics, student_tables) {
  EXPECT_NEAR(student_quantile(0.975, 1), std::tan(0.475 * std::acos(-1.0)), 1e-12);
  EXPECT_NEAR(student_quantile(0.95, 2), 2.919985580353726, 1e-13);
  EXPECT_NEAR(student_quantile(0.95, 9), 1.833112932656236, 1e-13);
  EXPECT_NEAR(student_quantile(0.9995, 15), 4.0727651, 5e-7);
  EXPECT_NEAR(student_quantile(0.975, 1e7), normal_quantile(0.975), 1e-6);
  EXPECT_EQ(student_cdf(0, 3), 0.5);
}

// One degree of freedom is Cauchy's distribution, two have a closed form as well.
TEST(Statistics, student_closed_forms) {
  for (double t : {-40.0, -3.0, -0.2, 0.7, 2.0, 55.0}) {
    EXPECT_NEAR(student_cdf(t, 1), 0.5 + std::atan(t) / std::acos(-1.0), 1e-15) << t;
    EXPECT_NEAR(student_cdf(t, 2), 0.5 + t / (2 * std::sqrt(2 + t * t)), 1e-15) << t;
  }
}

TEST(Statistics, quantiles_invert) {
  for (double dof : {0.5, 3.0, 7.5, 15.0, 200.0})
    for (double p : {1e-8, 0.01, 0.3, 0.5, 0.77, 0.999})
      EXPECT_NEAR(student_cdf(student_quantile(p, dof), dof), p, 1e-13) << dof << ' ' << p;
}

TEST(Statistics, median_of_odd_and_even_numbers) {
  EXPECT_EQ(median_of({3}), 3);
  EXPECT_EQ(median_of({9, 1, 5}), 5);
  EXPECT_EQ(median_of({4, 1, 9, 2}), 3);
}

}  // namespace
}  // namespace pellucid

// MIS weights add up to 1 over 70 orders of magnitude (numerics 7).
#include <gtest/gtest.h>

#include "support/test_scenes.h"
#include "support/twin.h"

namespace {

using namespace twin;
using pellucid::test::Random;

TEST(TwinMis, PairsOfWeightsAddUpToOne) {
  Random random(1);
  for (uint heuristic : {MIS_BALANCE, MIS_POWER, MIS_MAX})
    for (int i = 0; i < 300000; ++i) {
      const real a = real(std::pow(10.0, random.uniform(-35, 35)));
      const real b = i % 10 == 0 ? a : real(std::pow(10.0, random.uniform(-35, 35)));
      const real wa = mis_weight(heuristic, a, b, 1), wb = mis_weight(heuristic, b, a, 0);
      ASSERT_TRUE(wa >= 0 && wa <= 1 && wb >= 0 && wb <= 1) << a << " " << b;
      ASSERT_NEAR(double(wa) + double(wb), 1.0, 1e-6) << heuristic << ": " << a << " " << b;
    }
}

TEST(TwinMis, FollowsItsFormula) {
  Random random(2);
  for (int i = 0; i < 100000; ++i) {
    const real a = real(std::pow(10.0, random.uniform(-8, 8)));
    const real b = real(std::pow(10.0, random.uniform(-8, 8)));
    const double x = double(a), y = double(b);
    ASSERT_NEAR(double(mis_weight(MIS_BALANCE, a, b, 0)), x / (x + y), 1e-6);
    ASSERT_NEAR(double(mis_weight(MIS_POWER, a, b, 0)), x * x / (x * x + y * y), 1e-6);
    ASSERT_EQ(double(mis_weight(MIS_MAX, a, b, 0)), x > y ? 1.0 : 0.0);
  }
}

TEST(TwinMis, AgainstTheImpossible) {
  for (uint heuristic : {MIS_BALANCE, MIS_POWER, MIS_MAX})
    for (real a : {real(1e-35), real(1), real(1e35)})
      EXPECT_EQ(double(mis_weight(heuristic, a, 0, 0)), 1.0);
}

}  // namespace

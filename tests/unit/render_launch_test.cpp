// What merging is told of a pass: the radius as a function of its number alone.
#include "render/launch.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pellucid {
namespace {

Launch pass(uint number, double first_radius, double alpha, double least = 0) {
  Launch launch{};
  launch.iteration = number;
  launch.light_paths = 1000;
  set_merging(launch, first_radius, alpha, least);
  return launch;
}

// r_i^2 ~ i^(alpha - 1) [Knaus11].
TEST(Merging, radius_shrinks_by_the_law) {
  for (double alpha : {0.5, 2.0 / 3, 0.75, 1.0})
    for (double first : {1e-12, 0.03, 1e9}) {
      EXPECT_EQ(pass(0, first, alpha).radius, float(first));
      for (uint number : {9u, 9999u, 4294967294u}) {
        const double slope =
            std::log(double(pass(number, first, alpha).radius) / first) / std::log(number + 1.0);
        EXPECT_NEAR(slope, 0.5 * (alpha - 1), 1e-6) << alpha << ", pass " << number;
      }
    }
}

TEST(Merging, weights_and_power_count_the_same_photons) {
  for (uint number : {0u, 41u}) {
    const Launch launch = pass(number, 0.25, 0.75);
    const double r = launch.radius, eta = 3.14159265358979323846 * r * r * 1000;
    EXPECT_NEAR(launch.mis_vm / eta, 1, 3e-7);  // roundings of three floats
    EXPECT_NEAR(launch.mis_vc * eta, 1, 3e-7);
    EXPECT_NEAR(launch.merge_scale * eta, 1, 3e-7);
  }
}

// The same bits in a scene 2^k times as large.
TEST(Merging, radius_scales_exactly) {
  for (int k : {-33, -8, 8, 33}) {
    const Launch a = pass(17, 0.1, 0.75), b = pass(17, std::ldexp(0.1, k), 0.75);
    EXPECT_EQ(b.radius, std::ldexp(a.radius, k));
    EXPECT_EQ(b.mis_vm, std::ldexp(a.mis_vm, 2 * k));
    EXPECT_EQ(b.merge_scale, std::ldexp(a.merge_scale, -2 * k));
    EXPECT_EQ(b.mis_vc, std::ldexp(a.mis_vc, -2 * k));
  }
}

TEST(Merging, radius_stops_where_rounding_begins) {
  EXPECT_EQ(pass(999, 0.03, 0.5, 0.01).radius, 0.01f);
  EXPECT_GT(pass(9, 0.03, 0.5, 0.01).radius, 0.01f);
}

}  // namespace
}  // namespace pellucid

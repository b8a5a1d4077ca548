// Launches: how the radius of merging shrinks, where it stops, and what grid it has.
#include "render/launch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "shared/limits.h"

namespace pellucid {
namespace {

PackedScene scene_reaching(float coordinate) {
  PackedScene scene;
  scene.info.bounds_reach = F4{0, coordinate, 0.5f * coordinate, 0};
  return scene;
}

Launch pass(uint number, double first_radius, double alpha, double least = 0) {
  Launch launch{};
  launch.iteration = number;
  launch.light_paths = 1000;
  set_merging(launch, first_radius, alpha, least);
  return launch;
}

// r_i^2 ~ i^(alpha - 1) [Knaus11].
TEST(Launches, radius_shrinks_by_the_law) {
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

TEST(Launches, weights_and_power_count_the_same_photons) {
  for (uint number : {0u, 41u}) {
    const Launch launch = pass(number, 0.25, 0.75);
    const double r = launch.radius, eta = 3.14159265358979323846 * r * r * 1000;
    EXPECT_NEAR(launch.mis_vm / eta, 1, 3e-7);  // roundings of three floats
    EXPECT_NEAR(launch.mis_vc * eta, 1, 3e-7);
    EXPECT_NEAR(launch.merge_scale * eta, 1, 3e-7);
  }
}

// The same bits in a scene 2^k times as large.
TEST(Launches, radius_scales_exactly) {
  for (int k : {-33, -8, 8, 33}) {
    const Launch a = pass(17, 0.1, 0.75), b = pass(17, std::ldexp(0.1, k), 0.75);
    EXPECT_EQ(b.radius, std::ldexp(a.radius, k));
    EXPECT_EQ(b.mis_vm, std::ldexp(a.mis_vm, 2 * k));
    EXPECT_EQ(b.merge_scale, std::ldexp(a.merge_scale, -2 * k));
    EXPECT_EQ(b.mis_vc, std::ldexp(a.mis_vc, -2 * k));
  }
}

TEST(Launches, radius_stops_where_it_means_nothing) {
  EXPECT_EQ(pass(0xfffffffe, 0.25, 0.5, 1e-3).radius, 1e-3f);
  // 16 roundoffs of the largest coordinate, which the default keeps to, as well.
  const double least = 16 * std::ldexp(1000.0, -24);
  EXPECT_EQ(least_radius(scene_reaching(1000)), least);
  EXPECT_EQ(least_radius(scene_reaching(1e-15f)), double(MERGE_RADIUS_MIN));
  EXPECT_NO_THROW(check_radius(scene_reaching(1000), least));
  EXPECT_THROW(check_radius(scene_reaching(1000), least * 0.999), UsageError);
}

TEST(Launches, all_that_merging_needs_stays_a_number) {
  for (float radius : {MERGE_RADIUS_MIN, MERGE_RADIUS_MAX})
    for (uint paths : {1u, 0xffffffffu}) {
      Launch launch{};
      launch.light_paths = paths;
      set_merging(launch, radius, 1, 0);
      set_grid(launch, F4{1, 2, 3, 0}, GRID_BITS_MAX);
      EXPECT_TRUE(std::isnormal(launch.radius * launch.radius));
      EXPECT_TRUE(std::isnormal(launch.mis_vm));
      EXPECT_TRUE(std::isnormal(launch.cells_per_unit));
      EXPECT_GT(launch.mis_vc, 0.0f);
      EXPECT_TRUE(std::isfinite(launch.mis_vc));
    }
}

}  // namespace
}  // namespace pellucid

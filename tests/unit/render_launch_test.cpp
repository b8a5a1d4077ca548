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

Launch merging_launch(uint iteration, double alpha, double least) {
  Launch launch{};
  launch.light_paths = 1000;
  launch.iteration = iteration;
  set_merging(launch, 0.25, alpha, least);
  return launch;
}

TEST(Launches, radius_is_a_power_of_the_pass) {
  for (double alpha : {0.5, 2.0 / 3, 0.75, 1.0})
    for (uint i : {0u, 1u, 99u, 1000000u}) {
      const double expected = 0.25 * std::pow(i + 1.0, 0.5 * (alpha - 1));
      EXPECT_NEAR(merging_launch(i, alpha, 0).radius / expected, 1, 1e-6) << alpha << " " << i;
    }
}

TEST(Launches, radius_stops_where_it_means_nothing) {
  EXPECT_EQ(merging_launch(0xfffffffe, 0.5, 1e-3).radius, 1e-3f);
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

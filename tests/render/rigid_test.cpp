// Moves that reorder roundings: far from the origin and mirrored, the picture stays equal within
// noise (numerics.md A6, 9, 31).
#include <gtest/gtest.h>

#include "equality.h"
#include "stability/small_scenes.h"

namespace pellucid::test {
namespace {

constexpr int picture_size = 24, tile = 8, runs = 24;
constexpr double alpha = 1e-4 / (2 * 2 * 3 * 2);  // Bonferroni over this file's images

Runs collect(const Scene& scene, std::uint64_t seed) {
  Renderer renderer(scene, {"path", picture_size, picture_size});
  Sampling run;
  run.seed = seed + 99;
  const std::uint64_t needed = renderer.spp_for(run, tier_tolerance() / 13, 100000);
  run.spp = needed / runs + 1;
  Runs all(tile);
  for (int k = 0; k < runs; ++k) {
    run.seed = seed + std::uint64_t(k);
    all.add(renderer.render(run));
  }
  return all;
}

void expect_same(const Scene& a, const Scene& b) {
  for (const std::string& reason : compare_runs(collect(a, 1000), collect(b, 2000), alpha))
    ADD_FAILURE() << reason;
}

// Scenes on a dyadic grid, 2 units wide; vertices of generated meshes are off by half an ulp.
TEST(Rigid, far_from_the_origin) {
  for (const char* name : {"equal-lights", "equal-paint"})
    for (double distance : {2e2, 2e4}) {
      SCOPED_TRACE(std::string(name) + ", moved by " + std::to_string(distance));
      const Scene here = scene_named(name);
      Scene there = here;
      transform_points(there, glm::dvec3(1), {distance, -distance, distance});
      expect_same(there, here);
    }
}

// Scene and camera both mirrored: the same picture, if winding and sides of emission went along.
TEST(Rigid, mirrored) {
  for (const char* name : {"equal-lights", "equal-paint"}) {
    SCOPED_TRACE(name);
    const Scene here = scene_named(name);
    Scene there = here;
    transform_points(there, {-1, 1, 1}, {0, 0, 0});
    expect_same(there, here);
  }
}

}  // namespace
}  // namespace pellucid::test

// CF16: light from patch A to patch B is that from B to A, whatever both are in. Merging methods
// would need some 3e7 light paths for so little noise where their bias is below it:
// merging_test.cpp has them agree with bdpt.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "equality.h"
#include "render_harness.h"
#include "stability/small_scenes.h"
#include "support/statistics.h"

namespace pellucid::test {
namespace {

constexpr int runs = 24;
using Channels = std::array<Sample, 3>;

/// Means of the picture in runs, known to `relative`.
Channels means_of(const Scene& scene, const Build& build, std::uint64_t seed, double relative) {
  Renderer renderer(scene, build);
  Sampling run;
  run.max_depth = long_enough;
  run.seed = seed + 99;
  const auto most = std::uint64_t(100000 * tier_effort());
  run.spp = renderer.spp_for(run, relative, most) / std::uint64_t(runs) + 1;
  Channels means;
  for (int k = 0; k < runs; ++k) {
    run.seed = seed + std::uint64_t(k);
    const Picture picture = renderer.render(run);
    for (std::size_t c = 0; c < 3; ++c) means[c].push_back(picture.image(int(c)).mean);
  }
  return means;
}

/// The mean of `b` by these methods is `ratio` times that of `a` by `bdpt`.
void expect_reciprocal(const Scene& a, const Scene& b, double ratio,
                       const std::vector<std::string>& methods) {
  // Two such errors, 5 sigma of Student and an error of 3 fit into the tolerance.
  const double relative = tier_tolerance() / 11.5;
  Channels known = means_of(a, {"bdpt", 24, 24}, 100, relative);
  for (Sample& channel : known)
    for (double& mean : channel) mean *= ratio;
  std::uint64_t seed = 200;
  for (const std::string& method : methods) {
    const Channels swapped = means_of(b, {method, 24, 24}, seed, relative);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(welch(swapped[c], known[c], family_alpha / double(3 * methods.size()),
                      tier_tolerance() * estimate(known[c]).mean),
                "")
          << method << ", channel " << c;
    seed += 100;
  }
}

// In one room of all sorts of things, which takes a minute by two methods.
TEST(Reciprocity, walks_from_lights_can_be_swapped) {
  expect_reciprocal(scene_named("swap-a"), scene_named("swap-b"), 1, {"light", "bdpt"});
}

TEST(Reciprocity, walks_from_the_camera_can_be_swapped) {
  expect_reciprocal(scene_named("swap-a"), scene_named("swap-b"), 1, {"path", "nee"});
}

constexpr double ior = 1.5, side = 0.5;  // of both patches

/// Patch A in the air and patch B in a ball of glass, each seen from within its medium; one of them
/// shines.
Scene across_glass(bool from_glass) {
  Scene scene = empty_scene(0.625);
  const glm::dvec3 x(side, 0, 0), y(0, side, 0), in_air(0, 0, 2), in_glass(0.3, -0.2, 0.1);
  Shape& a = add_shape(scene, baked(make_rectangle(in_air - 0.5 * (x + y), y, x)));
  a.sides = 1;
  if (!from_glass) a.emission = Emission{Rgb(4, 3, 2), 1};
  Shape& b = add_shape(scene, baked(make_rectangle(in_glass - 0.5 * (x + y), x, y)));
  b.sides = 1;
  if (from_glass) b.emission = Emission{Rgb(4, 3, 2), 1};
  Material glass, clay, gold;
  glass.kind = MaterialKind::dielectric;
  glass.ior = ior;
  clay.kind = MaterialKind::oren_nayar;
  clay.reflectance = {0.3, 0.5, 0.7}, clay.roughness = 1;
  gold.kind = MaterialKind::conductor;
  gold.eta = {0.143, 0.375, 1.442}, gold.k = {3.983, 2.386, 1.603}, gold.alpha = 0.4;
  scene.materials.insert(scene.materials.end(), {glass, clay, gold});
  add_shape(scene, Sphere{{0, 0, 0}, 1.0}).material = 1;
  add_shape(scene, Sphere{{-0.4, 0.3, 0.3}, 0.25}).material = 2;  // beside B in the glass
  add_shape(scene, Sphere{{1.2, 0.5, 1.8}, 0.4}).material = 3;
  const glm::dvec3 floor(-3, -1.5, -3);
  add_shape(scene, baked(make_rectangle(floor, {0, 0, 6}, {6, 0, 0}))).material = 2;
  const double towards = from_glass ? 1 : -1;  // where the camera looks along z
  scene.camera.origin = (from_glass ? in_air : in_glass) - glm::dvec3(0, 0, towards * side / 2);
  scene.camera.forward = {0, 0, towards};
  scene.camera.right = {1, 0, 0}, scene.camera.up = {0, 1, 0};
  scene.camera.fov = 90;
  return scene;
}

// Radiance over n^2 is what both ends have in common.
TEST(Reciprocity, ends_in_glass_and_air_can_be_swapped) {
  expect_reciprocal(across_glass(true), across_glass(false), ior * ior, {"light", "bdpt", "path"});
}

}  // namespace
}  // namespace pellucid::test

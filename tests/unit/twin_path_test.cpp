// Whole paths of the twin: closed forms CF1 and CF2, and float against double (numerics A1).
#include <gtest/gtest.h>

#include "support/double_twin.h"
#include "support/statistics.h"
#include "support/test_scenes.h"
#include "support/twin.h"

namespace {

using namespace twin;
using namespace pellucid::test;
using pellucid::Emission;
using pellucid::Rgb;
using pellucid::Scene;

constexpr double pi_d = 3.14159265358979323846;
constexpr uint size = 64;

Launch launch_of(uint iteration, uint max_depth) {
  Launch launch{};
  launch.width = launch.height = size;
  launch.iteration = iteration;
  launch.seed = 12345;
  launch.max_depth = max_depth;
  launch.mis = MIS_BALANCE;
  return launch;
}

Scene looking_from(Scene scene, const glm::dvec3& origin) {
  scene.camera.origin = origin;
  scene.camera.fov = 90;
  scene.settings.width = scene.settings.height = int(size);
  return scene;
}

struct Path {
  double radiance;
  uint rays;
  double cut;
};

Path one_path(const TwinScene& twin, const Launch& launch, uint pixel) {
  const Rng rng{pixel, launch.iteration, launch.seed};
  const Random4 u = rng4(rng, DIM_PIXEL);
  uint rays = 0;
  const Ray ray =
      camera_ray(twin.packed.camera, real(pixel % size) + u.x, real(pixel / size) + u.y);
  VertexStore store = vertex_store_at(nullptr, nullptr, 0);
  real cut;
  const real3 found = path_radiance(&twin.data, launch, rng, ray, 1, &store, &rays, &cut);
  return {double(found.x), rays, double(cut)};
}

Moments mean_radiance(const Scene& scene, uint iterations, uint max_depth) {
  const TwinScene twin(scene);
  Moments m;
  for (uint i = 0; i < iterations; ++i)
    for (uint pixel = 0; pixel < size * size; ++pixel) {
      const Path path = one_path(twin, launch_of(i, max_depth), pixel);
      EXPECT_TRUE(std::isfinite(path.radiance) && path.radiance >= 0);
      m.add(path.radiance);
    }
  for (uint count : twin.diag) EXPECT_EQ(count, 0u);
  return m;
}

void expect_mean(const char* name, const Moments& m, double exact) {
  // 1e-5: rounding of float along some tens of bounces.
  EXPECT_GT(z_test(m, exact, 1e-5 * exact), sidak(family_alpha, 10))
      << name << ": " << m.mean << " +- " << m.standard_error() << ", exact " << exact;
  EXPECT_LT(m.standard_error(), 0.01 * exact) << name << ": too noisy to see an error";
}

constexpr uint unlimited = 0xffffffffu;

TEST(TwinPath, EmittingEnclosureCF1) {
  for (double rho : {0.5, 0.8}) {
    Scene scene = empty_scene(rho);
    add_shape(scene, lump(300)).emission = Emission{Rgb(1.0), 2};
    scene = looking_from(scene, {0.1, 0.05, 0});
    expect_mean("lump", mean_radiance(scene, 10, unlimited), 1 / (1 - rho));
    const int k = 3;
    expect_mean("capped", mean_radiance(scene, 10, k + 1), (1 - std::pow(rho, k + 1)) / (1 - rho));
  }
  Scene round = empty_scene(0.5);
  add_shape(round, pellucid::Sphere{{0, 0, 0}, 1}).emission = Emission{Rgb(1.0), 2};
  expect_mean("sphere", mean_radiance(looking_from(round, {0.3, 0.2, 0.1}), 10, unlimited), 2.0);
}

/// Of a walk between walls of albedo rho, a cap of k segments cuts off rho^k.
TEST(TwinPath, ThroughputCutOff) {
  for (double rho : {0.5, 0.9}) {
    Scene scene = empty_scene(rho);
    add_shape(scene, lump(300)).emission = Emission{Rgb(1.0), 2};
    const TwinScene twin(looking_from(scene, {0.1, 0.05, 0}));
    for (uint k : {1u, 2u, 9u}) {
      Moments cut;
      for (uint i = 0; i < 10; ++i)
        for (uint pixel = 0; pixel < size * size; ++pixel)
          cut.add(one_path(twin, launch_of(i, k), pixel).cut);
      const double exact = std::pow(rho, k);
      EXPECT_GT(z_test(cut, exact, 1e-5 * exact), sidak(family_alpha, 10))
          << "albedo " << rho << ", cap " << k << ": " << cut.mean << " +- " << cut.standard_error()
          << ", exact " << exact;
    }
    for (uint pixel = 0; pixel < size * size; ++pixel)
      ASSERT_EQ(one_path(twin, launch_of(0, unlimited), pixel).cut, 0.0) << "without a cap";
  }
  // Under the open sky, paths end by themselves before the third segment.
  Scene open = empty_scene(0.5);
  add_shape(open, pellucid::Sphere{{0, 0, -3}, 1});
  open.lights.push_back(pellucid::ConstantEnvironment{Rgb(1.0)});
  const TwinScene twin(looking_from(open, {0, 0, 0}));
  for (uint pixel = 0; pixel < size * size; ++pixel)
    ASSERT_EQ(one_path(twin, launch_of(0, 2), pixel).cut, 0.0) << "pixel " << pixel;
}

TEST(TwinPath, PointLightInSphereCF2) {
  Scene scene = empty_scene(0.5);
  add_shape(scene, pellucid::Sphere{{0, 0, 0}, 1});
  scene.lights.push_back(pellucid::PointLight{{0, 0, 0}, Rgb(pi_d)});
  expect_mean("CF2", mean_radiance(looking_from(scene, {0.2, 0.1, 0.3}), 10, unlimited), 1.0);
}

/// A black closed box under a bright sky stays black (numerics 2).
TEST(TwinPath, LightTightBox) {
  Scene scene = empty_scene(0.0);
  add_shape(scene, baked(pellucid::make_cube(glm::dvec3(0), glm::dvec3(2))));
  scene.lights.push_back(pellucid::ConstantEnvironment{Rgb(1e6)});
  for (const glm::dvec3& origin : {glm::dvec3(0), glm::dvec3(0.99, 0.99, 0.99)}) {
    const Moments m = mean_radiance(looking_from(scene, origin), 20, unlimited);
    EXPECT_EQ(m.mean, 0.0);
  }
}

/// Glass, gold and a lamp over a floor: enough branches for float and double to part ways.
Scene still_life() {
  Scene scene = empty_scene(0.7);
  pellucid::Material glass, gold;
  glass.kind = pellucid::MaterialKind::dielectric;
  gold.kind = pellucid::MaterialKind::conductor;
  gold.alpha = 0.2;
  gold.eta = Rgb(0.2), gold.k = Rgb(3.0);
  scene.materials.push_back(glass);
  scene.materials.push_back(gold);
  add_shape(
      scene,
      baked({{{-3, -1, 3}, {3, -1, 3}, {3, -1, -9}, {-3, -1, -9}}, {}, {{0, 1, 2}, {0, 2, 3}}}));
  add_shape(scene, pellucid::Sphere{{-0.7, 0, -3}, 0.7}).material = 1;
  add_shape(scene, lump(1000, {1.2, 0, -3.5})).material = 2;
  add_shape(scene, pellucid::Disk{{0, 3, -2}, {0, -1, 0}, 1}).emission = Emission{Rgb(5.0), 1};
  scene.lights.push_back(pellucid::ConstantEnvironment{Rgb(0.2)});
  return looking_from(scene, {0, 0.2, 1});
}

TEST(TwinPath, DivergenceBetweenFloatAndDouble) {
  const TwinScene twin(still_life());
  const ReferenceScene reference(twin.packed);
  constexpr uint iterations = 30;
  int paths = 0, divergent = 0;
  double sum = 0, difference = 0, all_float = 0, all_double = 0;
  for (uint i = 0; i < iterations; ++i)
    for (uint pixel = 0; pixel < size * size; ++pixel) {
      const Launch launch = launch_of(i, 32);
      const Path ours = one_path(twin, launch, pixel);
      const Random4 u = rng4({pixel, i, launch.seed}, DIM_PIXEL);
      uint rays = 0;
      const double other = reference
                               .path(launch, pixel, double(pixel % size) + double(u.x),
                                     double(pixel / size) + double(u.y), &rays)
                               .x;
      ++paths;
      all_float += ours.radiance, all_double += other;
      // Another branch shows as another number of rays or a visibly different value.
      if (rays != ours.rays || std::abs(ours.radiance - other) > 1e-2 * (0.1 + other)) {
        ++divergent;
        continue;
      }
      sum += other;
      difference += ours.radiance - other;
    }
  const double per_million = 1e6 * divergent / paths;
  std::printf(
      "%.0f of a million paths diverge; the others differ by %.1e of their mean; all by %.1e\n",
      per_million, difference / sum, all_float / all_double - 1);
  EXPECT_LE(per_million, is_float ? 2000 : 0);
  EXPECT_LT(std::abs(difference / sum), is_float ? 1e-5 : 1e-15);  // no drift in float
}

}  // namespace

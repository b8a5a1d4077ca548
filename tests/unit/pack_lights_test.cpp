// Packing of lights: order, powers, and the alias table.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/error.h"
#include "pack/pack.h"
#include "support/test_scenes.h"

namespace pellucid {
namespace {

using test::add_shape;
using test::empty_scene;
using test::Random;

/// Probability of each light according to the table alone.
std::vector<double> table_probabilities(const PackedScene& s) {
  const size_t n = s.info.light_count;
  std::vector<double> p(n, 0.0);
  for (size_t slot = 0; slot < n; ++slot) {
    const ::Light& light = s.lights[slot];
    EXPECT_GE(light.value.w, 0.0f);
    EXPECT_LE(light.value.w, 1.0f);
    EXPECT_LT(light.alias, n);
    p[slot] += light.value.w / double(n);
    p[light.alias] += (1.0 - light.value.w) / double(n);
  }
  return p;
}

/// float thresholds: each slot may be off by half an ulp of 1.
void expect_table_matches(const PackedScene& s) {
  const std::vector<double> p = table_probabilities(s);
  double sum = 0;
  for (size_t i = 0; i < p.size(); ++i) {
    const double from_slots = double(UNIT_ROUNDOFF) / double(p.size());
    // A strong light may be the alias of many slots.
    const double tolerance = 1e-6 * p[i] + from_slots;
    EXPECT_NEAR(p[i], s.lights[i].prob_pick, tolerance) << i;
    sum += s.lights[i].prob_pick;
  }
  EXPECT_NEAR(sum, 1.0, 1e-6);
}

Scene point_lights(int n, const std::function<double(int)>& power) {
  Scene scene = empty_scene();
  add_shape(scene, Sphere{});
  for (int i = 0; i < n; ++i) scene.lights.push_back(PointLight{{0, 0, 3}, Rgb(power(i))});
  return scene;
}

TEST(PackLights, AliasTableGivesThePowers) {
  Random random(1);
  for (int n : {1, 2, 3, 17, 1000}) {
    const Scene scene = point_lights(n, [&](int) { return std::pow(10.0, random.uniform(0, 6)); });
    const PackedScene s = pack_scene(scene, {8});
    expect_table_matches(s);
    double total = 0;
    for (const Light& l : scene.lights) total += std::get<PointLight>(l).intensity.x;
    for (size_t i = 0; i < scene.lights.size(); ++i)
      EXPECT_NEAR(s.lights[i].prob_pick, std::get<PointLight>(scene.lights[i]).intensity.x / total,
                  1e-7);
  }
}

TEST(PackLights, ManyUnequalLights) {
  Random random(2);
  const Scene scene =
      point_lights(100000, [&](int) { return std::pow(10.0, random.uniform(0, 6)); });
  expect_table_matches(pack_scene(scene, {8}));
}

TEST(PackLights, NoPowerIsNeverPicked) {
  const PackedScene s = pack_scene(point_lights(99, [](int i) { return i % 3 ? 0.0 : 1.0; }), {8});
  const std::vector<double> p = table_probabilities(s);
  for (size_t i = 0; i < p.size(); ++i) {
    if (i % 3 == 0) continue;
    EXPECT_EQ(p[i], 0.0) << i;
    EXPECT_EQ(s.lights[i].prob_pick, 0.0f);
  }
}

TEST(PackLights, AllBlackSharesEqually) {
  const PackedScene s = pack_scene(point_lights(4, [](int) { return 0.0; }), {8});
  for (double p : table_probabilities(s)) EXPECT_NEAR(p, 0.25, 1e-9);
}

TEST(PackLights, PowerOfEveryKind) {
  constexpr double pi = 3.14159265358979323846;
  Scene scene = empty_scene();
  add_shape(scene, Sphere{{0, 0, 0}, 2.0}).emission = Emission{Rgb(3.0), 1};
  add_shape(scene, Disk{{9, 0, 0}, {0, 0, 1}, 0.5}).emission = Emission{Rgb(1, 2, 3), 2};
  Mesh square =
      test::baked({{{0, 0, 9}, {2, 0, 9}, {2, 3, 9}, {0, 3, 9}}, {}, {{0, 1, 2}, {0, 2, 3}}});
  add_shape(scene, square).emission = Emission{Rgb(1.0), 1};
  scene.settings.filter = PixelFilter::box;
  scene.lights = {PointLight{{0, 0, 5}, Rgb(7.0)}, DirectionalLight{{0, 0, -1}, Rgb(0.1)},
                  ConstantEnvironment{Rgb(0.01)},
                  SpotLight{{0, 0, 5}, {0, 0, -1}, Rgb(20.0), 0.3, 0.5}};
  const PackedScene s = pack_scene(scene, {8});
  const double r = s.info.center_radius.w;
  const double power[] = {pi * 3 * 4 * pi * 4,
                          pi * 2 * 2 * pi * 0.25,
                          pi * 3,
                          pi * 3,
                          4 * pi * 7,
                          pi * r * r * 0.1,
                          4 * pi * pi * r * r * 0.01,
                          2 * pi * (1 - 0.5 * (std::cos(0.3) + std::cos(0.5))) * 20};
  const uint kinds[] = {LIGHT_SPHERE, LIGHT_DISK,        LIGHT_TRIANGLE,    LIGHT_TRIANGLE,
                        LIGHT_POINT,  LIGHT_DIRECTIONAL, LIGHT_ENVIRONMENT, LIGHT_SPOT};
  double total = 0;
  for (double p : power) total += p;
  ASSERT_EQ(s.info.light_count, 8u);
  EXPECT_EQ(s.info.environment, 6u);
  for (size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(s.lights[i].kind, kinds[i]);
    EXPECT_NEAR(s.lights[i].prob_pick, power[i] / total, 1e-6) << i;
  }
  expect_table_matches(s);
  const FeatureSet lights{FEAT_LIGHT_TRIANGLE,   FEAT_LIGHT_SPHERE, FEAT_LIGHT_DISK,
                          FEAT_LIGHT_POINT,      FEAT_LIGHT_SPOT,   FEAT_LIGHT_DIRECTIONAL,
                          FEAT_LIGHT_ENVIRONMENT};
  EXPECT_EQ(s.features,
            lights | FeatureSet({FEAT_TRIANGLES, FEAT_SPHERES, FEAT_DISKS, FEAT_DIFFUSE}));
  EXPECT_EQ(s.shapes[0].flags, SHAPE_EMIT_FRONT);
  EXPECT_EQ(s.shapes[1].flags, SHAPE_EMIT_FRONT | SHAPE_EMIT_BACK);
  EXPECT_EQ(s.shapes[2].first_light, 2u);
  EXPECT_EQ(s.lights[3].prim, s.shapes[2].first_prim + 1);
}

TEST(PackLights, BlackEmittersAreNoLights) {
  Scene scene = empty_scene();
  add_shape(scene, Sphere{}).emission = Emission{Rgb(0.0), 1};
  const PackedScene s = pack_scene(scene, {8});
  EXPECT_EQ(s.info.light_count, 0u);
  EXPECT_EQ(s.shapes[0].first_light, NONE);
}

TEST(PackLights, TwoEnvironmentsAreRefused) {
  Scene scene = empty_scene();
  scene.lights = {ConstantEnvironment{}, ConstantEnvironment{}};
  EXPECT_THROW(pack_scene(scene, {8}), InputError);
}

}  // namespace
}  // namespace pellucid

// Closed forms averaged over what the camera sees, for methods that cannot see a point: a floor
// under lamps of every kind, plates and sheets, by walks from the lights and by merging (CF4, CF5,
// CF6, CF7, CF13, CF17).
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "closed_form_cases.h"
#include "equality.h"
#include "render_harness.h"
#include "stability/closed_forms.h"
#include "support/statistics.h"

namespace pellucid::test {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double half = 0.4;     // of the picture on the floor
constexpr double radius = 0.04;  // of merging
/// What a disc of that radius adds to a function that bends by 2 over a length of 1, about 4 times
/// as sharply as any here: r^2/8 times its Laplacian.
constexpr double disc = radius * radius / 2;

/// A camera below the lamp that looks straight down at the floor y = 0.
Scene seen_from_above(Scene scene) {
  constexpr double height = 0.5;
  for (Shape& s : scene.shapes)
    if (s.name == "floor")
      for (glm::vec3& p : std::get<Mesh>(s.geometry).positions) p *= 0.1f;  // 2 x 2
  scene.camera.origin = {0, height, 0};
  scene.camera.forward = {0, -1, 0};
  scene.camera.right = {1, 0, 0}, scene.camera.up = {0, 0, 1};
  scene.camera.fov = 2 * std::atan(half / height) * 180 / pi;
  return scene;
}

/// Mean over the picture of what the floor sends up at (x, z); symmetric in both.
double mean_over_floor(const std::function<double(double, double)>& radiance) {
  return integrate(radiance, 0, half, 0, half, 1e-9) / (half * half);
}

void expect_value(const Scene& scene, double value,
                  const Methods& methods = {"light", "bdpt", "sppm", "bpm", "vcm"}) {
  constexpr int size = 8, runs = 32;
  for (const std::string& method : methods) {
    Build build{method, size, size};
    build.light_paths = 1 << 12;
    build.radius = radius, build.radius_alpha = 1;
    Renderer renderer(scene, build);
    Sampling run;
    // 4.5 sigma of the verdict, an error of 3 and that of the disc fit into the tolerance.
    const auto spp =
        renderer.spp_for(run, tier_tolerance() / 9, std::uint64_t(16384 * tier_effort()));
    run.spp = spp / runs + 1;
    Sample sample;
    for (int k = 0; k < runs; ++k) {
      run.seed = std::uint64_t(300 + k);
      sample.push_back(renderer.render(run).image(0).mean);
    }
    EXPECT_EQ(judge(estimate(sample), value, 1e-5 + disc), "") << method;
  }
}

TEST(Footprint, cf4_rectangle) {
  const std::vector<glm::dvec3> corners{{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}};
  expect_value(seen_from_above(scene_named("rectangle-light")),
               mean_over_floor([&](double x, double z) {
                 return polygon_form_factor({x, 0, z}, {0, 1, 0}, corners);  // rho Le = 1
               }));
}

TEST(Footprint, cf5_sphere) {
  expect_value(seen_from_above(scene_named("sphere-light")),
               mean_over_floor([](double x, double z) {
                 return 16 * 0.25 * 2 / std::pow(4 + x * x + z * z, 1.5);  // rho Le R^2 h / d^3
               }));
}

/// CF6 off its axis: a disc of radius 1 at height 1 is the limit of polygons.
TEST(Footprint, cf6_disc) {
  constexpr int sides = 720;
  std::vector<glm::dvec3> rim;
  for (int i = 0; i < sides; ++i)
    rim.emplace_back(std::cos(2 * pi * i / sides), 1, std::sin(2 * pi * i / sides));
  EXPECT_NEAR(polygon_form_factor({0, 0, 0}, {0, 1, 0}, rim), 0.5, 2e-5);
  Scene scene = seen_from_above(scene_named("rectangle-light"));
  for (Shape& s : scene.shapes)
    if (s.name == "light") s.geometry = Disk{{0, 1, 0}, {0, -1, 0}, 1.0};
  expect_value(scene, mean_over_floor([&](double x, double z) {
                 return polygon_form_factor({x, 0, z}, {0, 1, 0}, rim);
               }));
}

/// CF13 beside the alcove: from there it is its opening, 2 wide and 1 high, that hides the sky.
TEST(Footprint, cf13_half_sky) {
  constexpr double aside = 0.5;
  Scene scene = seen_from_above(scene_named("plane-half-sky"));
  scene.camera.origin.x = aside;
  const std::vector<glm::dvec3> opening{{0, 0, -1}, {0, 1, -1}, {0, 1, 1}, {0, 0, 1}};
  const double value = mean_over_floor([&](double x, double z) {
    double sky = 0;
    for (double side : {-1, 1})
      sky += 1 - polygon_form_factor({aside + side * x, 0, z}, {0, 1, 0}, opening);
    return sky;  // rho L = 2 times the mean of both sides
  });
  EXPECT_GT(value, 1.2) << "at the alcove it is 1";
  expect_value(scene, value);
}

/// CF7 by walks from the light: no mirror is in sight, and merging is in the table.
TEST(Footprint, cf7_plates) {
  for (const char* name : {"cf7_floor", "cf7_ceiling"}) {
    const Case c = closed_form_case(name);
    expect_value(c.scene, c.targets[0].expected.x, {"light"});
  }
}

/// CF17 by walks from the sky alone, on a sheet so small that it just fills the picture.
TEST(Footprint, cf17_sheets) {
  const std::pair<const char*, Methods> sheets[] = {{"cf17_oren_nayar", {"light", "bpm"}},
                                                    {"cf17_rough_plastic", {"light", "bpm"}},
                                                    {"cf17_rough_metal", {"light"}},
                                                    {"cf17_rough_glass_behind", {"light"}}};
  for (const auto& [name, methods] : sheets) {
    SCOPED_TRACE(name);
    Case c = closed_form_case(name);
    for (glm::vec3& p : std::get<Mesh>(c.scene.shapes.at(0).geometry).positions) p *= 0.012f;
    c.scene.camera.fov = 4;
    expect_value(c.scene, c.targets[0].expected.x, methods);
  }
}

TEST(Footprint, cf13_sun_and_sky) {
  expect_value(seen_from_above(scene_named("plane-sun")), 1);
  expect_value(seen_from_above(scene_named("plane-sky")), 1);
}

}  // namespace
}  // namespace pellucid::test

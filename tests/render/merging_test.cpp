// What merging alone can get wrong: light that no connection finds (CF10), the radius' bias in the
// open and at walls (CF7), light that leaks through thin ones, and which light is gathered where.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "closed_form_cases.h"
#include "equality.h"
#include "render_harness.h"
#include "stability/closed_forms.h"
#include "support/statistics.h"
#include "support/test_scenes.h"

namespace pellucid::test {
namespace {

constexpr double pi = 3.14159265358979323846;
const char* const merging[] = {"sppm", "bpm", "vcm"};
constexpr int runs = 24;

/// With one radius for all passes, so that the bias is that of this radius.
Build fixed_radius(const char* method, double radius, int size, uint light_paths) {
  Build b{method, size, size};
  b.radius = radius;
  b.radius_alpha = 1;
  b.light_paths = light_paths;
  return b;
}

/// Means of the picture in each of `runs` renders of so many passes, more in the full tier.
Runs runs_of(const Scene& scene, const Build& build, std::uint64_t spp, uint max_depth) {
  Renderer renderer(scene, build);
  Runs out(build.width);
  const auto passes = std::uint64_t(double(spp) * tier_effort());
  for (int k = 0; k < runs; ++k)
    out.add(renderer.render({passes, std::uint64_t(900 + k), max_depth, MIS_BALANCE}));
  return out;
}

// CF10's pane, its light a spot to waste fewer paths: nothing here lies outside its inner cone.
constexpr double light_height = 2, pane = 0.5, ior = 1.5;

Scene spot_pane_scene() {
  Scene scene = pane_scene(scene_named("slab"));
  SpotLight spot;
  spot.position = {0, 0, light_height};
  spot.direction = {0, 0, -1};
  spot.intensity = Rgb(1.0);
  spot.inner = 0.7, spot.outer = 0.75;
  scene.lights = {spot};
  return scene;
}

double irradiance(double x) {
  return irradiance_below_pane(std::abs(x), light_height, pane, ior);
}

/// The same averaged over a disc of radius r about x, up to r^4: what four points at r / sqrt(2)
/// give.
double gathered(double x, double r) {
  const double a = r / std::sqrt(2.0);
  return (irradiance(x + a) + irradiance(x - a) + 2 * irradiance(std::hypot(x, a))) / 4;
}

/// Radiance of the floor seen from below the pane, mean over the picture.
double seen_directly(double r) {
  constexpr double half = 0.75;  // of the picture on the floor
  const auto at = [&](double x, double y) { return gathered(std::hypot(x, y), r); };
  return 0.5 / pi * integrate(at, 0, half, 0, half, 1e-9) / (half * half);
}

constexpr double through_half = 0.4;  // tangent of half the field of view

/// The same from where the light is, through the pane.
double seen_through_glass(double r) {
  const auto at = [&](double u, double v) {
    const double cosine = 1 / std::sqrt(1 + u * u + v * v), sine = std::sqrt(1 - cosine * cosine);
    const double passed = 1 - fresnel(cosine, 1, ior, 0);
    return passed * passed * gathered(lands_below_pane(sine, light_height, pane, ior), r);
  };
  return 0.5 / pi * integrate(at, 0, through_half, 0, through_half, 1e-9) /
         (through_half * through_half);
}

// CF10 from below the pane and through it: light, glass, floor, glass, camera.
TEST(Merging, finds_light_through_glass_and_seen_through_glass) {
  constexpr double radius = 0.1;
  Scene below = spot_pane_scene(), above = below;
  above.camera.origin = {0, 0, light_height};
  above.camera.fov = 2 * std::atan(through_half) * 180 / pi;
  const double direct = seen_directly(radius), through = seen_through_glass(radius);
  for (const char* method : merging) {
    const Build build = fixed_radius(method, radius, 16, 1 << 13);
    // `vcm` connects where it can, which has no bias: 0.2 % at this radius.
    const double slack = std::string(method) == "vcm" ? 2.5e-3 : 1e-5;
    EXPECT_EQ(judge(estimate(runs_of(below, build, 16, 4).image[0]), direct, slack), "") << method;
    EXPECT_EQ(judge(estimate(runs_of(above, build, 16, 6).image[0]), through, 1e-5), "") << method;
  }
  for (const auto& pixel : Renderer(above, {"bdpt", 16, 16}).render({16, 1, 6, MIS_BALANCE}).pixels)
    ASSERT_EQ(pixel[0].mean, 0.0) << "no connection finds it";
}

// Mirrored in the disc that shows it the floor, the camera stands at z = 1.3 and looks at the
// middle of the spot, which is wider than its picture and the radius.
constexpr double disc_height = 0.9, disc_half = 0.08, disc_ior = 30;  // reflects 88 %
const glm::dvec3 disc_eye{-0.435, 0, 0.5}, disc_axis = glm::normalize(glm::dvec3(0.135, 0, 0.4));

/// The floor below the pane as a disc beside the beam reflects it.
Scene reflected_caustic(MaterialKind kind) {
  Scene scene = spot_pane_scene();
  Material material;
  material.kind = kind;
  material.ior = disc_ior;
  material.reflectance = Rgb(0.05);
  scene.materials.push_back(material);
  add_shape(scene, Disk{{-0.3, 0, disc_height}, {0, 0, -1}, 0.12}).material =
      uint(scene.materials.size() - 1);
  SpotLight& spot = std::get<SpotLight>(scene.lights.at(0));
  spot.inner = 0.12, spot.outer = 0.13;  // a radius of 0.22 on the floor
  scene.camera.origin = disc_eye;
  scene.camera.forward = disc_axis, scene.camera.right = {0, 1, 0};
  scene.camera.up = glm::cross(scene.camera.right, disc_axis);
  scene.camera.fov = 2 * std::atan(disc_half) * 180 / pi;
  return scene;
}

/// What the disc's mirror image of the floor adds up to, mean over the picture.
double seen_in_disc(double r) {
  const glm::dvec3 right{0, 1, 0}, up = glm::cross(right, disc_axis);
  const auto at = [&](double u, double v) {
    const glm::dvec3 d = glm::normalize(disc_axis + u * right + v * up);
    const double length = (2 * disc_height - disc_eye.z) / d.z;
    const double x = std::hypot(disc_eye.x + length * d.x, length * d.y);
    return fresnel(d.z, 1, disc_ior, 0) * gathered(x, r);
  };
  return 0.5 / pi * integrate(at, -disc_half, disc_half, -disc_half, disc_half, 1e-9) /
         (4 * disc_half * disc_half);
}

// A caustic in glass, and in the coat of a plastic: delta lobes keep a merge first, also where they
// share their surface with others.
TEST(Merging, finds_a_caustic_seen_in_glass_and_in_plastic) {
  constexpr double radius = 0.05;
  constexpr uint longest = 5;  // light, glass, glass, floor, disc, camera
  const double expected = seen_in_disc(radius);
  for (MaterialKind kind : {MaterialKind::dielectric, MaterialKind::plastic}) {
    const Scene scene = reflected_caustic(kind);
    const bool coat = kind == MaterialKind::plastic;
    // Below the coat the plastic scatters what no mirror shows, and so little of it at this `ior`.
    const double below = coat ? 1e-4 : 1e-5;
    for (bool first : {false, true}) {
      Build build = fixed_radius("vcm", radius, 16, 1 << 12);
      build.merge_first_only = first;
      EXPECT_EQ(judge(estimate(runs_of(scene, build, 16, longest).image[0]), expected, below), "")
          << (coat ? "plastic" : "glass") << (first ? ", first merges" : ", all merges");
    }
    const double connected = estimate(runs_of(scene, {"bdpt", 16, 16}, 1, longest).image[0]).mean;
    EXPECT_LE(connected, coat ? below * expected : 0) << "no connection finds it";
  }
}

// In the open the bias is that of an average over the disc, and grows as r^2 (accuracy.md 3).
TEST(Merging, bias_is_that_of_the_disc) {
  Scene scene = spot_pane_scene();
  scene.camera.fov = 0.1;  // one point, under the light
  double bias[2], error[2], expected[2];
  for (int i : {0, 1}) {
    const double r = i ? 1.0 : 0.5;
    const auto ring = [&](double s, double) { return irradiance(s) * s; };
    const double disc = 2 / (r * r) * integrate(ring, 0, r, 0, 1, 1e-9);
    const Estimate e = estimate(runs_of(scene, fixed_radius("sppm", r, 1, 1 << 14), 8, 4).image[0]);
    EXPECT_EQ(judge(e, 0.5 / pi * disc, 1e-5), "") << "radius " << r;
    bias[i] = 1 - e.mean * pi / 0.5 / irradiance(0);
    error[i] = e.error() * pi / 0.5 / irradiance(0);
    expected[i] = 1 - disc / irradiance(0);
  }
  const double slope = std::log2(bias[1] / bias[0]), known = std::log2(expected[1] / expected[0]);
  const double width = 4.5 * std::hypot(error[0] / bias[0], error[1] / bias[1]) / std::log(2.0);
  std::printf("bias %.3g +- %.2g at r = 0.5, %.3g +- %.2g at 1: r^%.3g (known: %.3g)\n", bias[0],
              error[0], bias[1], error[1], slope, known);
  EXPECT_NEAR(slope, known, width);
  EXPECT_LT(width, 0.3);
  EXPECT_NEAR(known, 2, 0.3) << "r^2, but for r^4";
}

// CF7: a disc cut by a wall finds too little. Over distances from 0 to r this adds up to 2 r / (3
// pi): a dark strip whose width goes with r.
TEST(Merging, dark_strip_at_a_wall_is_as_wide_as_the_radius) {
  constexpr double floor = 1, width = 0.5, plates = 1 / (1 - 0.6 * 0.7);
  const Scene scene = scene_named("mirror-strip");
  for (double r : {0.1, 0.2}) {
    const Estimate e =
        estimate(runs_of(scene, fixed_radius("sppm", r, 16, 1 << 10), 32, long_enough).image[0]);
    const double missing = (plates - e.mean) / (plates - floor) * width;
    const double error = e.error() / (plates - floor) * width, expected = 2 * r / (3 * pi);
    std::printf("radius %g: missing %.4g +- %.2g, expected %.4g\n", r, missing, error, expected);
    EXPECT_NEAR(missing, expected, 4.5 * error) << r;
    EXPECT_LT(4.5 * error, 0.25 * 2 * 0.1 / (3 * pi)) << r << ": too noisy";
  }
}

// Photons on the other side of a wall a tenth of the radius thick, of one without any thickness,
// and of two sheets that face the same way: straight from the lamp for `bpm`, by way of a ball for
// all.
TEST(Merging, nothing_leaks_through_a_thin_wall) {
  Scene two = scene_named("thin-wall"), sheet = two, alike = two, lit = two;
  sheet.shapes.erase(sheet.shapes.begin() + 1);
  for (glm::uvec3& t : std::get<Mesh>(alike.shapes.at(1).geometry).triangles) std::swap(t.y, t.z);
  lit.camera.origin.z *= -1, lit.camera.forward.z *= -1, lit.camera.right.x *= -1;
  for (const char* method : {"sppm", "bpm", "vcm"}) {
    const Build build = fixed_radius(method, 0.1, 16, 1 << 10);
    const auto render = [&](const Scene& scene) {
      return Renderer(scene, build).render({16, 1, {}, MIS_BALANCE});
    };
    for (const Scene* dark : {&two, &sheet, &alike})
      for (const auto& pixel : render(*dark).pixels) ASSERT_EQ(pixel[0].mean, 0.0) << method;
    EXPECT_GT(render(lit).image(0).mean, 0.01) << method;
  }
}

/// Metal of the named width in the place of the floor of `equal-metal`.
Scene metal_scene(double alpha) {
  Scene scene = scene_named("equal-metal");
  for (Shape& s : scene.shapes)
    if (s.name == "floor") scene.materials.at(std::size_t(s.material)).alpha = alpha;
  return scene;
}

void expect_equal(const Runs& a, const Runs& b, const std::string& name) {
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_EQ(
        welch(a.image[c], b.image[c], family_alpha, tier_tolerance() * estimate(b.image[c]).mean),
        "")
        << name << ", channel " << c;
}

// `sppm` follows lobes narrower than ALPHA_GATHER and gathers on wider ones. Either way light that
// takes one bounce is found by light samples and by chance alone, without bias.
TEST(Merging, one_bounce_has_no_bias_on_any_metal) {
  for (double alpha : {0.05, 0.2}) {
    const Scene scene = metal_scene(alpha);
    expect_equal(runs_of(scene, fixed_radius("sppm", 0.1, 16, 16), 128, 2),
                 runs_of(scene, {"path", 16, 16}, 128, 2), "alpha " + std::to_string(alpha));
  }
}

// A radius of 1/80 of the room leaves a bias of a few thousandths: discs cut at its edges (above).
TEST(Merging, finds_what_others_find) {
  constexpr uint longest = 6;
  struct Case {
    const char* name;
    Scene scene;
    const char* method;
  };
  const std::vector<Case> cases{{"paint", scene_named("equal-paint"), "sppm"},
                                {"caustic", scene_named("equal-caustic"), "vcm"},
                                {"caustic", scene_named("equal-caustic"), "bpm"},
                                {"metal", scene_named("equal-metal"), "sppm"}};
  for (const Case& c : cases) {
    const Runs known = runs_of(c.scene, {"bdpt", 16, 16}, 128, longest);
    expect_equal(runs_of(c.scene, fixed_radius(c.method, 0.025, 16, 1 << 11), 96, longest), known,
                 std::string(c.name) + ", " + c.method);
  }
}

// Light of a point through a ball of glass, seen through a pane, which nothing else finds; beside
// it light that `vcm` also finds by light samples.
TEST(Merging, methods_agree_on_a_caustic_seen_through_glass) {
  constexpr uint longest = 8;
  const Scene scene = scene_named("sds");
  // The bias goes with r^2: so much of two radii is the limit at none.
  const auto limit = [&](const char* method) {
    const Runs wide = runs_of(scene, fixed_radius(method, 0.1, 16, 1 << 11), 24, longest);
    Runs narrow = runs_of(scene, fixed_radius(method, 0.05, 16, 1 << 11), 96, longest);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < wide.image[c].size(); ++k)
        narrow.image[c][k] = (4 * narrow.image[c][k] - wide.image[c][k]) / 3;
    return narrow;
  };
  expect_equal(limit("vcm"), limit("sppm"), "sds");
}

}  // namespace
}  // namespace pellucid::test

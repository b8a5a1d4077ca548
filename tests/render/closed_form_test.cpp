// Closed forms: every method that can see a value gives it, and those that cannot say so.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "closed_form_cases.h"
#include "integrators/reach.h"
#include "integrators/registry.h"
#include "render_harness.h"
#include "stability/closed_forms.h"

namespace pellucid::test {
namespace {

constexpr int picture_size = 48;

bool has(const Methods& methods, const std::string& name) {
  return std::find(methods.begin(), methods.end(), name) != methods.end();
}

/// Every pixel has the value. Some 30 roundings of 2^-24 lie behind a sample of the longest
/// constant paths here (glass, met 10 times), all the same way at worst.
void expect_constant(const Measured& picture, const Rgb& expected) {
  constexpr double bound = 2e-6;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(picture.pixels[i][std::size_t(c)].mean, expected[c], bound * expected[c])
          << "pixel " << i << " channel " << c;
}

void expect_value(const Measured& picture, const Rgb& expected, double slack) {
  constexpr double across = 0.005;  // change of the value over the footprint of a picture
  std::size_t inside = 0;
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(judge(picture.image[std::size_t(c)], expected[c], slack), "") << "channel " << c;
    for (const auto& p : picture.pixels) {
      const Estimate e = p[std::size_t(c)];
      inside += std::abs(e.mean - expected[c]) <= 5 * e.error() + across * expected[c];
    }
  }
  // Normal pixels leave 5 sigma once in 2 million; 3 % of them forgives those few samples whose
  // distribution is skewed, yet a wrong stripe or corner shows.
  EXPECT_GE(double(inside), 0.97 * 3 * double(picture.pixels.size()));
}

void check_target(Renderer& renderer, const std::string& method, const Target& target,
                  double slack) {
  // The verdict's 4.5 sigma, an error of 3 and the slack must fit into the tolerance.
  constexpr std::uint64_t least = 256, most = 16384;
  const double error = (tier_tolerance() - slack) / 8;
  Sampling run;
  run.max_depth = target.max_depth;
  if (has(target.constant, method)) {
    expect_constant(renderer.measure(run), target.expected);
    return;
  }
  run.spp =
      std::max(least, renderer.spp_for(run, error, std::uint64_t(double(most) * tier_effort())));
  expect_value(renderer.measure(run), target.expected, slack);
}

class ClosedForm : public testing::TestWithParam<std::string> {};

TEST_P(ClosedForm, holds) {
  const Case c = closed_form_case(GetParam());
  for (const std::string& method : c.methods) {
    Build build{method, c.size, c.size};
    const bool merged = c.radius > 0 && find_integrator(method).uses(Bundle::grid);
    if (merged) build.radius = c.radius, build.radius_alpha = 1;
    Renderer renderer(c.scene, build);
    for (const Target& target : c.targets) {
      SCOPED_TRACE(method +
                   (target.max_depth ? ", depth " + std::to_string(*target.max_depth) : ""));
      check_target(renderer, method, target, c.slack);
    }
    EXPECT_TRUE(
        unreachable_paths(find_integrator(method), optics_of(renderer.packed(), {})).empty());
  }
  for (const std::string& method : c.blind) {
    SCOPED_TRACE(method);
    Renderer renderer(c.scene, {method, c.size, c.size});
    EXPECT_FALSE(
        unreachable_paths(find_integrator(method), optics_of(renderer.packed(), {})).empty());
    for (const auto& pixel : renderer.render({}).pixels)
      for (const Estimate& e : pixel) ASSERT_EQ(e.mean, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Values, ClosedForm, testing::ValuesIn(closed_form_names()),
                         [](const auto& test) { return test.param; });

void expect_black(const Scene& scene) {
  for (const Integrator& method : integrators()) {
    Renderer renderer(scene, {method.name, 16, 16});
    for (const auto& pixel : renderer.render({}).pixels)
      for (const Estimate& e : pixel) ASSERT_EQ(e.mean, 0.0) << method.name;
  }
}

void turn_round(Shape& shape) {
  for (glm::uvec3& t : std::get<Mesh>(shape.geometry).triangles) std::swap(t.y, t.z);
}

// Which side of a surface shines or reflects: exactly nothing on the other.
TEST(Sides, one_sided_light_is_dark_behind) {
  Scene scene = scene_named("rectangle-light");
  turn_round(scene.shapes.at(1));
  expect_black(scene);
  scene = scene_named("sphere-light");
  scene.camera.origin = {0, 2, 0};  // inside: it shines outwards
  expect_black(scene);
}

TEST(Sides, one_sided_surface_is_black_behind) {
  Scene scene = scene_named("sheet");
  scene.shapes.at(0).sides = 1;
  turn_round(scene.shapes.at(0));
  expect_black(scene);
}

// The formulas themselves, against the digits of numerics.md 3.
TEST(ClosedFormValues, match_the_published_digits) {
  const std::vector<glm::dvec3> square{{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}};
  EXPECT_NEAR(polygon_form_factor({0, 0, 0}, {0, 1, 0}, square), 0.554126, 1e-6);
  EXPECT_NEAR(polygon_form_factor({1, 0, 0}, {0, 1, 0}, square), 0.334750, 1e-6);
  const double pane[] = {0.923077, 0.904327, 0.836232, 0.441229}, degrees[] = {0, 45, 60, 80};
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(pane_transmission(degrees[i], 1.5), pane[i], 1e-6);
  // Nearly smooth interfaces tend to Fresnel's value; the lobe of Phong to 1 seen from above.
  EXPECT_NEAR(ggx_reflected(0.5, 0.02, 1, 1.5, 0), fresnel(0.5, 1, 1.5, 0), 1e-3);
  EXPECT_NEAR(ggx_transmitted(0.5, 0.02, 1, 1.5), (1 - fresnel(0.5, 1, 1.5, 0)) / 2.25, 1e-3);
  EXPECT_NEAR(phong_albedo(1, 12), 1, 1e-5);
}

/// Single-scattering microfacets never gain, and lose no more than at their worst angle for every
/// time that a path meets them.
void expect_small_loss(const Material& material, double least) {
  Scene scene = scene_named("ball");
  scene.materials.at(0) = material;
  for (const char* method : {"naive", "nee", "path", "reference", "bdpt"}) {
    SCOPED_TRACE(method);
    Renderer renderer(scene, {method, picture_size, picture_size});
    Sampling run;
    run.spp = 512;
    const Measured picture = renderer.measure(run);
    const Estimate mean = picture.image[0];
    EXPECT_LE(mean.mean, 1 + 1e-6 + 4.5 * mean.error());
    EXPECT_GE(mean.mean, least);
    // Elsewhere a pixel's own variance says little: sharp lobes under uniform directions.
    if (method != std::string("naive") && method != std::string("path")) continue;
    for (const auto& p : picture.pixels) {
      ASSERT_LE(p[0].mean, 1 + 1e-6 + 5 * p[0].error());
      ASSERT_GE(p[0].mean, least - 1e-6 - 5 * p[0].error());
    }
  }
}

TEST(WhiteFurnace, rough_metal_loses_only_what_single_scattering_must) {
  Material m;
  m.kind = MaterialKind::conductor;
  m.eta = Rgb(0.0);
  m.k = Rgb(1.0);
  m.alpha = 0.5;
  double least = 1;
  for (double mu = 0.05; mu < 1; mu += 0.05)
    least = std::min(least, ggx_reflected(mu, m.alpha, 1, 0, 1));
  EXPECT_GT(least, 0.65);
  expect_small_loss(m, least);
}

TEST(WhiteFurnace, rough_glass_loses_only_what_single_scattering_must) {
  Material m;
  m.kind = MaterialKind::dielectric;
  m.alpha = 0.2;
  double least = 1;  // energy, hence without the change of radiance
  for (double mu = 0.05; mu < 1; mu += 0.05)
    for (bool inside : {false, true}) {
      const double near = inside ? 1.5 : 1, far = inside ? 1 : 1.5;
      least =
          std::min(least, ggx_reflected(mu, m.alpha, near, far, 0) +
                              ggx_transmitted(mu, m.alpha, near, far) * far * far / near / near);
    }
  EXPECT_GT(least, 0.8);
  // In, out, and one echo inside: nearly all that a path does; what remains is below the noise.
  expect_small_loss(m, least * least * least);
}

}  // namespace
}  // namespace pellucid::test

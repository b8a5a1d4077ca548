// Light samples of every kind against the density of the same direction found by chance, and
// against closed forms (numerics 11, CF4-CF6).
#include <gtest/gtest.h>

#include <numeric>

#include "support/double_twin.h"
#include "support/statistics.h"
#include "support/test_scenes.h"
#include "support/twin.h"

namespace {

using namespace twin;
using namespace pellucid::test;
using pellucid::Emission;
using pellucid::Mesh;
using pellucid::Rgb;
using pellucid::Scene;

constexpr double pi_d = 3.14159265358979323846;

/// A light seen from a point.
struct LightCase {
  std::string name;
  Scene scene;
  glm::dvec3 p;
  glm::dvec3 axis;  ///< towards the light
  double width;     ///< tan of half the angle it fills, roughly
  double seen;      ///< share of samples that carry light
};

Scene with(std::variant<Mesh, pellucid::Sphere, pellucid::Disk> geometry, int sides) {
  Scene scene = empty_scene();
  add_shape(scene, std::move(geometry)).emission = Emission{Rgb(2.0), sides};
  return scene;
}

Mesh triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return baked({{a, b, c}, {}, {{0, 1, 2}}});
}

std::vector<LightCase> light_cases() {
  std::vector<LightCase> all;
  const Mesh facing = triangle({-1, -1, 2}, {-1, 1, 2}, {1, -1, 2});  // front side down
  all.push_back({"triangle", with(facing, 1), {0, 0, 0}, {-0.3, -0.3, 2}, 0.3, 1});
  all.push_back({"triangle from behind", with(facing, 1), {0, 0, 4}, {-0.3, -0.3, -2}, 0.3, 0});
  all.push_back({"triangle, both sides", with(facing, 2), {0, 0, 4}, {-0.3, -0.3, -2}, 0.3, 1});
  all.push_back({"triangle, slanted",
                 with(triangle({0, 0, 1}, {0.1, 1, 2}, {3, 0, 1.2}), 2),
                 {0.2, 0.1, 0},
                 {1, .4, 1.4},
                 0.4,
                 1});
  all.push_back({"sphere", with(pellucid::Sphere{{1, 2, 3}, 1}, 1), {0, 0, 0}, {1, 2, 3}, 0.17, 1});
  all.push_back(
      {"sphere, close", with(pellucid::Sphere{{0, 0, 1.02}, 1}, 1), {0, 0, 0}, {0, 0, 1}, 0.7, 1});
  all.push_back({"sphere from inside, both sides",
                 with(pellucid::Sphere{{0, 0, 0}, 1}, 2),
                 {0.3, 0.2, 0.4},
                 {1, 1, 1},
                 1.0,
                 1});
  all.push_back({"sphere from inside, one side",
                 with(pellucid::Sphere{{0, 0, 0}, 1}, 1),
                 {0.3, 0.2, 0.4},
                 {1, 1, 1},
                 1.0,
                 0});
  all.push_back(
      {"sphere, far", with(pellucid::Sphere{{0, 600, 800}, 1}, 1), {0, 0, 0}, {0, 3, 4}, 6e-4, 1});
  all.push_back(
      {"sphere, tiny", with(pellucid::Sphere{{0, 0, 2}, 1e-6}, 1), {0, 0, 0}, {0, 0, 1}, 3e-7, 1});
  all.push_back(
      {"disk", with(pellucid::Disk{{0, 1, 2}, {0, 0, -1}, 1}, 1), {0, 0, 0}, {0, 1, 2}, 0.3, 1});
  all.push_back({"disk from behind",
                 with(pellucid::Disk{{0, 1, 2}, {0, 0, 1}, 1}, 1),
                 {0, 0, 0},
                 {0, 1, 2},
                 0.3,
                 0});
  all.push_back({"disk, slanted, both sides",
                 with(pellucid::Disk{{1, 1, 2}, {0.6, 0, 0.8}, 1.5}, 2),
                 {0, 0, 0},
                 {1, 1, 2},
                 0.5,
                 1});
  Scene sky = empty_scene();
  sky.lights.push_back(pellucid::ConstantEnvironment{Rgb(0.5)});
  all.push_back({"environment", sky, {1, 2, 3}, {0, 0, 1}, 1.0, 1});
  // Two emitters and the sky: densities of one direction include the pick.
  Scene both = with(pellucid::Sphere{{0, 0, 4}, 1}, 1);
  add_shape(both, facing).emission = Emission{Rgb(1.0), 2};
  all.push_back({"two emitters, one behind the other", both, {0, 0, 0}, {0, 0, 1}, 0.3, -1});
  return all;
}

LightSample sample(const TwinScene& twin, const glm::dvec3& p, Random& random) {
  const uint pick = random.word(), u = random.word(), v = random.word();
  return light_sample(&twin.data, to_real3(p), U4{pick, u, v, random.word()});
}

/// Directions too close for float are a matter of the double build.
bool resolvable(const LightCase& c) {
  return !is_float || c.width > 1e-5;
}

TEST(TwinLight, SamplesFollowTheDensityOfChance) {
  const std::vector<LightCase> cases = light_cases();
  constexpr int n = is_float ? 1000000 : 300000;
  unsigned seed = 1;
  for (const LightCase& c : cases) {
    if (c.seen < 0 || !resolvable(c)) continue;
    const TwinScene twin(c.scene);
    const ReferenceScene reference(twin.packed);
    const LobeGrid grid(c.axis, 1.37 * c.width, 36, 40);  // borders of cells off the silhouettes
    std::vector<double> expected = grid.integrate_cells(
        [&](const glm::dvec3& w) { return reference.light_pdf(c.p, w); }, 1e-7);
    const double sum = std::accumulate(expected.begin(), expected.end(), 0.0);
    // Where samples carry light, the density integrates to 1: quadrature along silhouettes.
    EXPECT_NEAR(sum, c.seen, 1e-3) << c.name;
    for (double& e : expected) e *= n;
    std::vector<double> observed(expected.size(), 0.0);
    Random random(++seed);
    double dark = 0, impossible = 0, slivers = 0;
    for (int i = 0; i < n; ++i) {
      const LightSample s = sample(twin, c.p, random);
      if (is_black(s.radiance)) {
        ++dark;
        continue;
      }
      const auto cell = size_t(grid.cell(to_dvec3(s.wi)));
      if (expected[cell] > 0) {
        ++observed[cell];
        continue;
      }
      // Only the corner of a cell that quadrature has missed is an excuse: the density a millionth
      // towards the middle of the light must not be 0.
      const glm::dvec3 inwards = to_dvec3(s.wi) + 1e-6 * c.width * glm::normalize(c.axis);
      ++(reference.light_pdf(c.p, glm::normalize(inwards)) > 0 ? slivers : impossible);
    }
    if (c.seen == 0) {
      EXPECT_EQ(dark, n) << c.name;
      continue;
    }
    EXPECT_EQ(dark + impossible, 0) << c.name;
    EXPECT_LT(slivers, 1e-4 * n) << c.name;
    const ChiSquare test = chi_square(observed, expected);
    EXPECT_TRUE(accepted(test, sidak(family_alpha, int(cases.size()))))
        << c.name << ": " << test.describe();
  }
}

TEST(TwinLight, DensityOfSampleIsDensityOfChance) {
  unsigned seed = 50;
  for (const LightCase& c : light_cases()) {
    if (c.seen == 0 || !resolvable(c)) continue;
    const TwinScene twin(c.scene);
    Random random(++seed);
    int beyond = 0, lost = 0, compared = 0;
    constexpr int n = 200000;
    for (int i = 0; i < n; ++i) {
      const LightSample s = sample(twin, c.p, random);
      const Ray ray = make_ray(to_real3(c.p), s.wi, REAL_MAX);
      const Hit hit = twin.trace(ray);
      real density, cosine = 1;
      if (s.at_infinity) {
        if (hit.prim != NONE) continue;
        density = light_pdf_environment(&twin.data);
      } else {
        if (hit.prim == NONE) {
          ++lost;  // a sample on the outline that rounding puts beside it
          continue;
        }
        const Surface at = surface_at(&twin.data, ray, hit);
        if (length3(at.p - s.target) > real(1e-3) * length3(s.target - ray.o)) continue;  // hidden
        density = light_pdf_surface(&twin.data, at.light, at.p, at.ng, ray.o, ray.d);
        cosine = r_abs(dot3(at.ng, ray.d));
        EXPECT_FALSE(is_black(light_emitted(&twin.data, &at, -ray.d)) && cosine > real(1e-3))
            << c.name;
      }
      ++compared;
      // Area densities divide by a cosine whose error is a few roundoffs of 1.
      const double tolerance = is_float ? 1e-4 + 1e-6 / double(cosine) : 1e-6;
      if (!(std::abs(double(density / s.pdf_w) - 1) < tolerance)) ++beyond;
    }
    EXPECT_EQ(beyond, 0) << c.name;
    EXPECT_LE(lost, is_float ? n / 500 : n / 100000) << c.name;
    EXPECT_GT(compared, n / 4) << c.name;
  }
}

TEST(TwinLight, ConeOfSphereHasDensityOne) {
  // 2 pi (1 - cos) of the exact cone, computed without cancellation in long double.
  for (double radius = 1; radius >= 1e-6; radius /= 10)
    for (double distance : {1.02, 2.0, 1e3}) {
      const TwinScene twin(with(pellucid::Sphere{{0, 0, distance}, radius}, 1));
      Random random(2);
      const double r = double(float(radius)), d = double(float(distance));
      if (d < 1.0001 * r) continue;
      const long double sine2 = (long double)r * r / ((long double)d * d);
      const double cone = double(2 * pi_d * sine2 / (1 + std::sqrt(1 - sine2)));
      EXPECT_NEAR(double(sample(twin, {0, 0, 0}, random).pdf_w) * cone, 1.0,
                  is_float ? 2e-5 : 1e-12)
          << radius << " " << distance;
    }
}

/// Mean of radiance cos / pdf over light samples from p on a floor with normal z, per unit of Le.
Moments irradiance(const Scene& scene, const glm::dvec3& p, unsigned seed, int n) {
  const TwinScene twin(scene);
  Random random(seed);
  Moments m;
  for (int i = 0; i < n; ++i) {
    const LightSample s = sample(twin, p, random);
    m.add(is_black(s.radiance)
              ? 0.0
              : double(s.radiance.x) * std::max(0.0, double(s.wi.z)) / double(s.pdf_w));
  }
  return m;
}

/// The quadrant term of CF4.
double quadrant(double x, double y) {
  const double sx = std::sqrt(1 + x * x), sy = std::sqrt(1 + y * y);
  return (x / sx * std::atan(y / sx) + y / sy * std::atan(x / sy)) / (2 * pi_d);
}

void expect_irradiance(const char* name, const Scene& scene, const glm::dvec3& p, double exact) {
  constexpr int n = 400000;
  const Moments m = irradiance(scene, p, 7, n);
  const double slack = (is_float ? 1e-5 : 1e-9) * exact;
  EXPECT_GT(z_test(m, exact, slack), sidak(family_alpha, 20))
      << name << ": " << m.mean << " +- " << m.standard_error() << ", exact " << exact;
  EXPECT_LT(m.standard_error(), 0.003 * exact) << name << ": too noisy to see an error";
}

TEST(TwinLight, RectangleCF4) {
  const Mesh square =
      baked({{{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}}, {}, {{0, 1, 2}, {0, 2, 3}}});
  const Scene scene = with(square, 1);  // radiance 2
  EXPECT_NEAR(4 * quadrant(1, 1), 0.554126, 1e-6);
  expect_irradiance("centre", scene, {0, 0, 0}, 2 * pi_d * 4 * quadrant(1, 1));
  expect_irradiance("edge", scene, {1, 0, 0}, 2 * pi_d * 2 * quadrant(2, 1));
}

TEST(TwinLight, SphereCF5) {
  for (double x : {0.0, 1.0})
    for (double radius : {0.5, 1e-2, 1e-4, 1e-6}) {
      const double distance2 = 4 + x * x, packed = double(float(radius));
      const double exact = 2 * pi_d * packed * packed * 2 / std::pow(distance2, 1.5);
      expect_irradiance("sphere", with(pellucid::Sphere{{x, 0, 2}, radius}, 1), {0, 0, 0}, exact);
    }
}

TEST(TwinLight, DiskCF6) {
  for (double radius : {1.0, 0.1, 1e-3}) {
    const double r = double(float(radius));
    expect_irradiance("disk", with(pellucid::Disk{{0, 0, 2}, {0, 0, -1}, radius}, 1), {0, 0, 0},
                      2 * pi_d * r * r / (r * r + 4));
  }
}

TEST(TwinLight, SkyGivesPi) {
  Scene sky = empty_scene();
  sky.lights.push_back(pellucid::ConstantEnvironment{Rgb(0.5)});
  expect_irradiance("sky", sky, {0, 0, 0}, 0.5 * pi_d);
}

/// The mean of intensity over all directions is the power that the packer says, over 4 pi; in the
/// cones it is what the angles say. Down to cones of a hundredth of a degree.
TEST(TwinLight, SpotsSendTheirPower) {
  for (double outer : {1e-4, 0.01, 0.5, 1.5, pi_d})
    for (double softness : {0.0, 0.3, 1.0}) {
      Scene scene = empty_scene();
      pellucid::SpotLight spot;
      spot.direction = glm::normalize(glm::dvec3(1, 2, -2));
      spot.outer = outer;
      spot.inner = outer * (1 - softness);
      scene.lights = {spot};
      const TwinScene twin(scene);
      const ::Light& light = twin.packed.lights[0];
      const Frame frame = frame_from_normal(to_real3(spot.direction));
      const auto falloff = [&](double angle) {
        const real3 local = REAL3(std::sin(angle) * 0.6, std::sin(angle) * 0.8, std::cos(angle));
        return double(spot_falloff(light, normalize3(to_world(frame, local))));
      };
      constexpr int steps = 4000;  // midpoints of 1 - cos, where the falloff is a cubic
      const double most = 2 * std::pow(std::sin(0.5 * outer), 2);
      double sum = 0;
      for (int i = 0; i < steps; ++i)
        sum += falloff(2 * std::asin(std::sqrt(0.5 * most * (i + 0.5) / steps))) / steps;
      // A hard edge may fall anywhere within a step, a direction of float 1e-7 beside its cone.
      EXPECT_NEAR(2 * pi_d * most * sum / pellucid::spot_solid_angle(spot), 1.0,
                  1e-3 + (is_float ? 1e-7 / outer : 0))
          << outer << " " << softness;
      if (softness > 0 && outer < pi_d) {
        EXPECT_NEAR(falloff(0.99 * spot.inner), 1.0, 1e-6);
        EXPECT_EQ(falloff(1.01 * outer), 0.0);
        EXPECT_GT(falloff(0.99 * outer), 0.0);
      }
    }
}

TEST(TwinLight, DeltaLights) {
  Scene scene = empty_scene();
  scene.lights.push_back(pellucid::PointLight{{0, 3, 4}, Rgb(50.0)});
  Random random(8);
  const LightSample point = sample(TwinScene(scene), {0, 0, 0}, random);
  EXPECT_TRUE(point.delta && !point.at_infinity);
  EXPECT_NEAR(double(point.radiance.x), 2.0, 1e-6);
  EXPECT_NEAR(double(point.wi.z), 0.8, 1e-6);
  EXPECT_EQ(double(point.pdf_w), 1.0);
  scene.lights = {pellucid::SpotLight{{0, 3, 4}, {0, -0.6, -0.8}, Rgb(50.0), 0.1, 0.2}};
  const LightSample spot = sample(TwinScene(scene), {0, 0, 0}, random);
  EXPECT_TRUE(spot.delta && !spot.at_infinity);
  EXPECT_NEAR(double(spot.radiance.x), 2.0, 1e-6);
  EXPECT_NEAR(double(spot.wi.z), 0.8, 1e-6);
  EXPECT_TRUE(is_black(sample(TwinScene(scene), {0, 9, 0}, random).radiance));
  scene.lights = {pellucid::DirectionalLight{{0, 0, -1}, Rgb(3.0)}};
  const LightSample sun = sample(TwinScene(scene), {0, 0, 0}, random);
  EXPECT_TRUE(sun.delta && sun.at_infinity);
  EXPECT_EQ(double(sun.wi.z), 1.0);
  EXPECT_EQ(double(sun.radiance.x), 3.0);
}

}  // namespace

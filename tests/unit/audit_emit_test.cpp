// Light walks start with the power of all lights, from points and in directions of the density
// they claim.
#include <gtest/gtest.h>

#include <functional>

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

/// One light of its kind over a floor that gives the scene its size, and its power.
struct EmitCase {
  const char* name;
  Scene scene;
  double watts;
  bool scaled_by_disc;  ///< times the area of the scene's disc
};

std::vector<EmitCase> emit_cases() {
  const Scene floor = [] {
    Scene s = empty_scene();
    add_shape(s, pellucid::Disk{{0.5, 0, -3}, {0, 0, 1}, 4});
    return s;
  }();
  std::vector<EmitCase> all;
  const auto surface = [&](const char* name,
                           std::variant<pellucid::Mesh, pellucid::Sphere, pellucid::Disk> geometry,
                           int sides, double area) {
    Scene scene = floor;
    add_shape(scene, std::move(geometry)).emission = Emission{Rgb(2.0), sides};
    all.push_back({name, scene, 2 * pi_d * sides * area, false});
  };
  const auto light = [&](const char* name, pellucid::Light l, double watts, bool scaled) {
    Scene scene = floor;
    scene.lights = {l};
    all.push_back({name, scene, watts, scaled});
  };
  const pellucid::Mesh triangle = baked({{{0, 0, 0}, {0, 2, 0}, {3, 0, 1}}, {}, {{0, 1, 2}}});
  const double area = 0.5 * glm::length(glm::cross(glm::dvec3(0, 2, 0), glm::dvec3(3, 0, 1)));
  for (int sides : {1, 2}) {
    surface("triangle", triangle, sides, area);
    surface("sphere", pellucid::Sphere{{1, 0, 0}, 0.5}, sides, pi_d);
    surface("disk", pellucid::Disk{{0, 1, 0}, {0, 0, -1}, 2}, sides, 4 * pi_d);
  }
  light("point", pellucid::PointLight{{1, 2, 3}, Rgb(5.0)}, 20 * pi_d, false);
  const pellucid::SpotLight spot{{0, 0, 1}, {0.6, 0, -0.8}, Rgb(3.0), 0.3, 0.8};
  light("spot", spot, 3 * pellucid::spot_solid_angle(spot), false);
  light("directional", pellucid::DirectionalLight{{0, 0.6, -0.8}, Rgb(2.0)}, 2, true);
  light("environment", pellucid::ConstantEnvironment{Rgb(0.5)}, 2 * pi_d, true);
  Scene both = floor;  // picked in proportion to power
  add_shape(both, pellucid::Sphere{{1, 0, 0}, 0.5}).emission = Emission{Rgb(2.0), 1};
  both.lights = {pellucid::PointLight{{1, 2, 3}, Rgb(0.1)}};
  all.push_back({"sphere and point", both, 2 * pi_d * pi_d + 0.4 * pi_d, false});
  return all;
}

double disc_area(const TwinScene& twin) {
  const double r = twin.packed.info.center_radius.w;
  return pi_d * r * r;
}

EmitSample emit(const TwinScene& twin, Random& random) {
  const uint x = random.word(), y = random.word(), z = random.word(), w = random.word();
  Random4 direction;
  direction.x = real(random.unit24()), direction.y = real(random.unit24());
  direction.z = real(random.unit24()), direction.w = 0;
  return light_emit(&twin.data, {x, y, z, w}, direction);
}

TEST(AuditEmit, CarriesThePowerOfAllLights) {
  for (const EmitCase& c : emit_cases()) {
    const TwinScene twin(c.scene);
    const double watts = c.watts * (c.scaled_by_disc ? disc_area(twin) : 1.0);
    EXPECT_NEAR(twin.packed.light_power / watts, 1.0, 1e-6) << c.name;
    Random random(3);
    Moments m;
    for (int i = 0; i < 100000; ++i) m.add(double(emit(twin, random).beta.x));
    // 1e-6: pick probabilities, radii and areas are floats.
    EXPECT_GT(z_test(m, watts, 2e-6 * watts), sidak(family_alpha, 12))
        << c.name << ": " << m.mean << " +- " << m.standard_error() << ", exact " << watts;
    EXPECT_LT(m.standard_error(), 0.01 * watts) << c.name;
  }
}

/// Density that the definition gives a start; the pick is certain.
double density_of(const TwinScene& twin, const EmitCase& c, const EmitSample& e) {
  const ::Light& light = twin.packed.lights[e.light];
  switch (light.kind) {
    case LIGHT_POINT:
      return 1 / (4 * pi_d);
    case LIGHT_SPOT:
      return 1 / (2 * pi_d * (1 - std::cos(0.8)));
    case LIGHT_DIRECTIONAL:
      return 1 / disc_area(twin);
    case LIGHT_ENVIRONMENT:
      return 1 / (4 * pi_d * disc_area(twin));
    default:  // power = pi radiance area sides
      return std::abs(glm::dot(to_dvec3(e.ng), to_dvec3(e.ray.d))) / (0.5 * c.watts);
  }
}

TEST(AuditEmit, DensityIsWhatTheKindSays) {
  for (const EmitCase& c : emit_cases()) {
    const TwinScene twin(c.scene);
    if (twin.packed.lights.size() > 1) continue;
    Random random(4);
    for (int i = 0; i < 2000; ++i) {
      const EmitSample e = emit(twin, random);
      ASSERT_NEAR(double(e.pdf) / density_of(twin, c, e), 1.0, 2e-6) << c.name;
      ASSERT_NEAR(double(length3(e.ray.d)), 1.0, 1e-6) << c.name;
      if (is_black(e.beta)) continue;  // the edge of a spot
      const uint kind = twin.packed.lights[e.light].kind;
      if (kind > LIGHT_DISK) continue;
      const uint flags = twin.packed.shapes[1].flags;
      const double eye = double(light_pdf_emit_surface(&twin.data, e.light, flags)) *
                         std::abs(double(dot3(e.ng, e.ray.d)));
      ASSERT_NEAR(double(e.pdf) / eye, 1.0, 2e-6) << c.name;
    }
  }
}

/// The mean of something over starts, and its value under the density claimed.
struct Mean {
  std::string name;
  double exact;
  std::function<double(const EmitSample&)> of;
  Moments m{};
};

glm::dvec3 direction_of(const EmitSample& e) {
  return to_dvec3(e.ray.d);
}
const glm::dvec3 any_axis = glm::normalize(glm::dvec3(1, 2, 3));

/// Surface lights: cosine-weighted directions from points uniform by area.
std::vector<Mean> surface_means(const TwinScene& twin) {
  const auto cosine = [](const EmitSample& e) { return glm::dot(to_dvec3(e.ng), direction_of(e)); };
  const auto length2 = [](const glm::dvec3& v) { return glm::dot(v, v); };
  const double front = twin.packed.shapes[1].flags & SHAPE_EMIT_BACK ? 0.5 : 1.0;
  std::vector<Mean> means = {
      {"|cos|", 2.0 / 3, [=](const EmitSample& e) { return std::abs(cosine(e)); }},
      {"cos^2", 0.5, [=](const EmitSample& e) { return cosine(e) * cosine(e); }},
      {"front", front, [=](const EmitSample& e) { return cosine(e) > 0 ? 1.0 : 0.0; }}};
  switch (twin.packed.lights[0].kind) {
    case LIGHT_TRIANGLE:  // corners at x = 0, 0, 3 and y = 0, 2, 0
      means.push_back({"x", 1, [](const EmitSample& e) { return double(e.p.x); }});
      means.push_back({"y", 2.0 / 3, [](const EmitSample& e) { return double(e.p.y); }});
      break;
    case LIGHT_SPHERE:
      means.push_back({"(n.a)^2", 1.0 / 3, [](const EmitSample& e) {
                         return std::pow(glm::dot(to_dvec3(e.ng), any_axis), 2);
                       }});
      break;
    default:
      means.push_back({"r^2", 2, [=](const EmitSample& e) {
                         return length2(to_dvec3(e.p) - glm::dvec3(0, 1, 0));
                       }});
  }
  return means;
}

/// Lights at infinity: points uniform on the disc that faces the light.
std::vector<Mean> disc_means(const TwinScene& twin) {
  const glm::dvec3 centre = to_dvec3(load3(twin.packed.info.center_radius));
  const double r2 = disc_area(twin) / pi_d;
  const auto across2 = [=](const EmitSample& e) {
    const glm::dvec3 v = to_dvec3(e.ray.o) - centre;
    const glm::dvec3 across = v - direction_of(e) * glm::dot(v, direction_of(e));
    return glm::dot(across, across) / r2;
  };
  return {{"r^2", 0.5, across2},
          {"r^4", 1.0 / 3, [=](const EmitSample& e) { return across2(e) * across2(e); }}};
}

std::vector<Mean> means_of(const TwinScene& twin) {
  const uint kind = twin.packed.lights[0].kind;
  if (kind <= LIGHT_DISK) return surface_means(twin);
  std::vector<Mean> means;
  if (kind == LIGHT_DIRECTIONAL || kind == LIGHT_ENVIRONMENT) means = disc_means(twin);
  const auto along = [](const EmitSample& e) { return glm::dot(direction_of(e), any_axis); };
  if (kind == LIGHT_POINT || kind == LIGHT_ENVIRONMENT) {
    means.push_back({"d.a", 0, along});
    means.push_back({"(d.a)^2", 1.0 / 3, [=](const EmitSample& e) { return along(e) * along(e); }});
  }
  if (kind == LIGHT_SPOT)  // uniform in the cosine
    means.push_back({"cos", 0.5 * (1 + std::cos(0.8)), [](const EmitSample& e) {
                       return glm::dot(direction_of(e), glm::dvec3(0.6, 0, -0.8));
                     }});
  return means;
}

TEST(AuditEmit, PointsAndDirectionsFollowTheirDensity) {
  for (const EmitCase& c : emit_cases()) {
    const TwinScene twin(c.scene);
    if (twin.packed.lights.size() > 1) continue;
    std::vector<Mean> means = means_of(twin);
    Random random(6);
    for (int i = 0; i < 100000; ++i) {
      const EmitSample e = emit(twin, random);
      for (Mean& mean : means) mean.m.add(mean.of(e));
    }
    for (const Mean& mean : means)
      EXPECT_GT(z_test(mean.m, mean.exact, 1e-6), sidak(family_alpha, 60))
          << c.name << ", " << mean.name << ": " << mean.m.mean << " +- " << mean.m.standard_error()
          << ", exact " << mean.exact;
  }
}

}  // namespace

// Lights, their powers, and the alias table by which every method picks one.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "pack/packer.h"

namespace pellucid {
namespace {

constexpr double pi = 3.14159265358979323846;

double mean(const Rgb& c) {
  return (c.x + c.y + c.z) / 3.0;
}

/// Without cancellation for narrow cones.
double one_minus_cos(double angle) {
  const double s = std::sin(0.5 * angle);
  return 2 * s * s;
}

struct Builder {
  PackedScene& out;
  std::vector<double> power;

  void add(uint kind, uint prim, const Rgb& value, const glm::dvec3& position, double watts,
           Feature feature) {
    ::Light light{};
    light.kind = kind;
    light.prim = prim;
    light.value = to_f4(value);
    light.position = to_f4(position);
    out.lights.push_back(light);
    power.push_back(watts);
    out.features.set(feature);
  }

  glm::dvec3 position(uint vertex) const {
    const F4& p = out.positions[vertex];
    return {p.x, p.y, p.z};
  }

  void add_shape(const Shape& shape, ::Shape& packed) {
    const Rgb radiance = shape.emission->radiance;
    const double flux = pi * mean(radiance) * shape.emission->sides;  // per area
    packed.first_light = static_cast<uint>(out.lights.size());
    if (const Mesh* mesh = std::get_if<Mesh>(&shape.geometry)) {
      for (uint i = 0; i < mesh->triangles.size(); ++i) {
        const Triangle& t = out.triangles[packed.first_prim + i];
        const glm::dvec3 v0 = position(t.v0);
        const double area = 0.5 * glm::length(glm::cross(position(t.v1) - v0, position(t.v2) - v0));
        add(LIGHT_TRIANGLE, packed.first_prim + i, radiance, {}, flux * area, FEAT_LIGHT_TRIANGLE);
      }
    } else if (const Sphere* s = std::get_if<Sphere>(&shape.geometry)) {
      add(LIGHT_SPHERE, packed.first_prim, radiance, {}, flux * 4 * pi * s->radius * s->radius,
          FEAT_LIGHT_SPHERE);
    } else {
      const double r = std::get<Disk>(shape.geometry).radius;
      add(LIGHT_DISK, packed.first_prim, radiance, {}, flux * pi * r * r, FEAT_LIGHT_DISK);
    }
  }

  /// Lights at infinity send their power through the scene's bounding disc.
  void add_light(const Light& light) {
    const double r = out.info.center_radius.w > 0.0f ? out.info.center_radius.w : 1.0;
    const double disc = pi * r * r;
    if (const auto* p = std::get_if<PointLight>(&light)) {
      add(LIGHT_POINT, NONE, p->intensity, p->position, 4 * pi * mean(p->intensity),
          FEAT_LIGHT_POINT);
    } else if (const auto* s = std::get_if<SpotLight>(&light)) {
      add(LIGHT_SPOT, NONE, s->intensity, s->position, spot_solid_angle(*s) * mean(s->intensity),
          FEAT_LIGHT_SPOT);
      out.lights.back().position.w = float(one_minus_cos(s->inner));
      out.lights.back().axis = to_f4(s->direction, one_minus_cos(s->outer));
    } else if (const auto* d = std::get_if<DirectionalLight>(&light)) {
      add(LIGHT_DIRECTIONAL, NONE, d->irradiance, d->direction, disc * mean(d->irradiance),
          FEAT_LIGHT_DIRECTIONAL);
    } else {
      const auto& e = std::get<ConstantEnvironment>(light);
      if (out.info.environment != NONE) throw InputError("the scene has two environment lights");
      out.info.environment = static_cast<uint>(out.lights.size());
      add(LIGHT_ENVIRONMENT, NONE, e.radiance, {}, 4 * pi * disc * mean(e.radiance),
          FEAT_LIGHT_ENVIRONMENT);
    }
  }
};

/// Exponent of the brightest light's radiance; of lights without a surface, what they make of a
/// white one, points from the far side of the scene. The film counts in fractions of it.
int brightness_exponent(const PackedScene& scene) {
  double brightest = 0;
  for (const ::Light& light : scene.lights) {
    double value = std::max({light.value.x, light.value.y, light.value.z});
    const double r = scene.info.center_radius.w > 0.0f ? scene.info.center_radius.w : 1.0;
    if (light.kind == LIGHT_POINT || light.kind == LIGHT_SPOT) value /= r * r;
    brightest = std::max(brightest, value);
  }
  int exponent = 0;
  std::frexp(brightest, &exponent);
  return exponent;
}

/// Vose's alias table in double. A light of zero power is never picked; if all are, they share
/// equally.
void build_alias(std::vector<double> power, std::vector<::Light>& lights) {
  const size_t n = lights.size();
  double total = std::accumulate(power.begin(), power.end(), 0.0);
  if (!(total > 0.0)) {
    std::fill(power.begin(), power.end(), 1.0);
    total = double(n);
  }
  if (!std::isfinite(total)) throw InputError("the lights' total power is not finite");
  // A light without power hands its slot on, whatever rounding leaves over below.
  const auto strongest = uint(std::max_element(power.begin(), power.end()) - power.begin());
  std::vector<double> scaled(n);
  std::vector<uint> small, large;
  for (size_t i = 0; i < n; ++i) {
    lights[i].prob_pick = float(power[i] / total);
    lights[i].alias = power[i] > 0.0 ? uint(i) : strongest;
    lights[i].value.w = power[i] > 0.0 ? 1.0f : 0.0f;
    scaled[i] = power[i] / total * double(n);
    (scaled[i] < 1.0 ? small : large).push_back(uint(i));
  }
  while (!small.empty() && !large.empty()) {
    const uint s = small.back(), l = large.back();
    small.pop_back();
    lights[s].value.w = float(scaled[s]);
    lights[s].alias = l;
    scaled[l] -= 1.0 - scaled[s];
    if (scaled[l] < 1.0) {
      large.pop_back();
      small.push_back(l);
    }
  }
}

}  // namespace

void pack_lights(const Scene& scene, PackedScene& out) {
  out.info.environment = NONE;
  Builder builder{out, {}};
  for (size_t i = 0; i < scene.shapes.size(); ++i)
    if (scene.shapes[i].emission && mean(scene.shapes[i].emission->radiance) > 0.0)
      builder.add_shape(scene.shapes[i], out.shapes[i]);
  for (const Light& light : scene.lights) builder.add_light(light);
  out.light_power = std::accumulate(builder.power.begin(), builder.power.end(), 0.0);
  if (!out.lights.empty()) build_alias(builder.power, out.lights);
  out.info.light_count = static_cast<uint>(out.lights.size());
  out.brightness_exponent = brightness_exponent(out);
}

}  // namespace pellucid

// Scenes, values and methods. A case is a name and a function that makes it.
#include "closed_form_cases.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "closed_form_table.h"
#include "render_harness.h"
#include "stability/closed_forms.h"

namespace pellucid::test {
namespace {

constexpr double pi = 3.14159265358979323846;
const Methods next_event{"nee", "path", "bdpt"};  // where chance would need too many samples
const Methods next_event_only{"nee", "path"};     // whose every sample of a delta light is alike
const Methods by_chance{"naive", "reference"};    // blind to point and directional lights

Case shipped(const std::string& scene, double value, const Methods& constant = {}) {
  return {"", scene_named(scene), {{grey(value), {}, constant}}, all, {}};
}

Shape& shape_named(Scene& scene, const std::string& name) {
  for (Shape& s : scene.shapes)
    if (s.name == name) return s;
  throw std::runtime_error("the scene has no shape " + name);
}

/// CF1, also capped: after d segments 1 - rho^d. Walls close to the camera make it too noisy for
/// `light`, which has CF14 (light_test.cpp).
Case furnace() {
  const Rgb rho(0.5, 0.75, 0.8);
  Case c{"", scene_named("furnace"), {{grey(1), {}, {}}}, all, {}};
  c.targets.push_back({1.0 - rho, 1, all});
  for (unsigned depth : {3u, 11u})  // at 2, NEE between neighbouring facets is too noisy alone
    c.targets.push_back({1.0 - glm::pow(rho, Rgb(depth)), depth, {}});
  c.size = 32;
  return c;
}

/// CF2: light of a point; methods that rely on chance are blind to it.
Case point_in_sphere() {
  return {"",
          scene_named("point-in-sphere"),
          {{grey(1), {}, {}}},
          {"nee", "path", "bdpt", "light", "sppm", "bpm", "vcm"},
          by_chance,
          1e-5,
          48,
          0.1};
}

/// CF8.
Case shell() {
  return {"",
          scene_named("shell"),
          {{grey(1), {}, {}}},
          {"naive", "nee", "path", "reference", "bdpt", "light", "sppm", "bpm", "vcm"},
          {},
          1e-5,
          40,
          0.1};
}

/// CF7, of the floor and of the ceiling. What is seen is farther from the mirrors than the radius;
/// of what merges later, at most rho1 rho2 of the light, discs that hang over a mirror lose
/// 2 r / (3 pi) times border over area.
Case plates(bool ceiling) {
  constexpr double radius = 0.02, lost = 0.6 * 0.7 * 2 * radius / (3 * pi) * 8 / 4;
  Case c{"", scene_named("plates"), {{grey(ceiling ? 0.7 : 1), {}, {}}}, all, {}, lost, 32, radius};
  c.methods.insert(c.methods.end(), {"sppm", "bpm", "vcm"});
  if (ceiling) c.scene.camera.forward *= -1, c.scene.camera.right *= -1;
  return c;
}

/// CF4 with the light turned by `degrees` about its x axis and scaled by `size` about its centre,
/// as bright as gives the same order of radiance.
Case rectangle_light(double degrees, double size, const Methods& methods) {
  Case c{"", scene_named("rectangle-light"), {}, methods, {}};
  Shape& light = shape_named(c.scene, "light");
  Mesh& mesh = std::get<Mesh>(light.geometry);
  const glm::dvec3 center(0, 1, 0);
  const double t = degrees * pi / 180;
  for (glm::vec3& p : mesh.positions) {
    const glm::dvec3 d = (glm::dvec3(p) - center) * size;
    p = center + glm::dvec3(d.x, d.y * std::cos(t) - d.z * std::sin(t),
                            d.y * std::sin(t) + d.z * std::cos(t));
  }
  light.emission->radiance /= size * size;
  c.scene.camera.fov = 0.005;  // seen edge-on, the light changes quickly over the floor
  const double rho = 0.5, le = light.emission->radiance.x;
  double factor = 0;
  for (const glm::uvec3& i : mesh.triangles)
    factor += polygon_form_factor({0, 0, 0}, {0, 1, 0},
                                  {mesh.positions[i.x], mesh.positions[i.y], mesh.positions[i.z]});
  c.targets = {{grey(rho * le * factor), {}, {}}};
  return c;
}

/// CF4 with the light turned round and shining on both sides.
Case two_sided_light() {
  Case c = rectangle_light(180, 1, all);
  shape_named(c.scene, "light").emission->sides = 2;
  return c;
}

/// CF6: a coaxial disc of radius R at height h: rho Le R^2 / (R^2 + h^2).
Case disc_light() {
  Case c{"", scene_named("rectangle-light"), {{grey(0.5), {}, {}}}, all, {}};
  shape_named(c.scene, "light").geometry = Disk{{0, 1, 0}, {0, -1, 0}, 1.0};
  return c;
}

/// CF5 with radius R at constant Le R^2: the same value however small the light.
Case sphere_light(const std::string& scene, double radius, double value, const Methods& methods) {
  Case c{"", scene_named(scene), {{grey(value), {}, {}}}, methods, {}};
  Shape& light = shape_named(c.scene, "light");
  Sphere& sphere = std::get<Sphere>(light.geometry);
  light.emission->radiance *= std::pow(sphere.radius / radius, 2);
  sphere.radius = radius;
  return c;
}

/// CF13: the sun at `degrees` from the normal: rho E cos / pi, the same in every sample.
Case sun(double degrees) {
  Case c{"", scene_named("plane-sun"), {}, next_event, by_chance};
  const double t = degrees * pi / 180;
  auto& light = std::get<DirectionalLight>(c.scene.lights.at(0));
  light.direction = {std::sin(t), -std::cos(t), 0};
  c.targets = {{grey(0.5 * light.irradiance.x * std::cos(t) / pi), {}, next_event_only}};
  return c;
}

/// CF9 by a sheet without thickness in the place of the pane.
Case thin_slab(int degrees) {
  Case c = shipped(degrees ? "slab-" + std::to_string(degrees) : "slab",
                   pane_transmission(degrees, 1.5));
  c.scene.materials.at(0).kind = MaterialKind::thin_dielectric;
  shape_named(c.scene, "pane").geometry = Disk{{0, 0, 0}, {0, 0, 1}, 30.0};
  return c;
}

/// A spot on the axis above a floor, seen `degrees` off its middle: rho I falloff cos^3 / (pi h^2),
/// with the cubic of cosines as falloff.
Case spot_on_floor(double degrees) {
  Case c{"", scene_named("spot-floor"), {}, next_event, by_chance};
  const auto& spot = std::get<SpotLight>(c.scene.lights.at(0));
  const double cosine = std::cos(degrees * pi / 180), x = std::tan(degrees * pi / 180);
  c.scene.camera.origin.x = x;
  c.scene.camera.fov = 0.01;  // the falloff changes quickly over the floor
  const double t = std::clamp(
      (cosine - std::cos(spot.outer)) / (std::cos(spot.inner) - std::cos(spot.outer)), 0.0, 1.0);
  const double e = spot.intensity.x * t * t * (3 - 2 * t) * std::pow(cosine, 3);
  c.targets = {{grey(0.5 * e / pi), {}, degrees > 0 ? Methods{} : next_event_only}};
  return c;
}

/// A spot in the middle of CF2's sphere, seen where it does not shine: what all its power Phi makes
/// of interreflection, rho^2 Phi / ((1 - rho) 4 pi^2).
Case spot_in_sphere() {
  Case c = point_in_sphere();
  SpotLight spot;
  spot.position = {0, 0, 0};
  spot.direction = -c.scene.camera.forward;
  spot.intensity = Rgb(8.0);
  spot.inner = 0.3, spot.outer = 0.9;
  c.scene.lights = {spot};
  const double power = 8.0 * 2 * pi * (1 - 0.5 * (std::cos(0.3) + std::cos(0.9)));
  c.targets = {{grey(0.25 * power / (0.5 * 4 * pi * pi)), {}, {}}};
  return c;
}

/// CF3: lossless solids vanish.
Case white_furnace(const std::string& kind, const Methods& constant) {
  return shipped("white-furnace-" + kind, 1, constant);
}

/// And paper, which walks from the sky reach as well.
Case white_diffuse() {
  Case c = merged(white_furnace("diffuse", {"naive"}));
  c.methods.emplace_back("light");
  return c;
}

/// CF3 on metal that reflects all: extinction without absorption.
Case white_metal() {
  Case c = shipped("ball", 1, material_only);
  Material& m = c.scene.materials.at(0);
  m.kind = MaterialKind::conductor;
  m.eta = Rgb(0.0);
  m.k = Rgb(1.0);
  return c;
}

Table table() {
  Table t = sheets();
  t.insert(
      t.end(),
      {{"cf1_furnace", furnace},
       {"cf2_point_in_sphere", point_in_sphere},
       {"cf3_white_diffuse", white_diffuse},
       {"cf3_white_mirror", [] { return by_every_method(white_furnace("mirror", material_only)); }},
       {"cf3_white_glass", [] { return by_every_method(white_furnace("glass", material_only)); }},
       {"cf3_white_metal", [] { return by_every_method(white_metal()); }},
       {"cf4_centre", [] { return merged(shipped("rectangle-light", 0.554126)); }},
       {"cf4_edge", [] { return merged(shipped("rectangle-light-edge", 0.334750)); }},
       {"cf4_tilted_30", [] { return merged(rectangle_light(30, 1, all)); }},
       {"cf4_two_sided", [] { return merged(two_sided_light()); }},
       {"cf4_tilted_89_small", [] { return rectangle_light(89, 0.01, next_event); }},
       {"cf4_small", [] { return rectangle_light(0, 1e-4, next_event); }},
       {"cf5_below", [] { return merged(shipped("sphere-light", 1)); }},
       {"cf5_aside", [] { return merged(shipped("sphere-light-offset", 16 * 0.0447214)); }},
       {"cf6_disc", [] { return merged(disc_light()); }},
       {"cf6_disk_light", [] { return merged(shipped("disk-light", 1)); }},
       {"spot_middle", [] { return merged(spot_on_floor(0)); }},
       {"spot_falloff", [] { return merged(spot_on_floor(25)); }},
       {"spot_power", spot_in_sphere},
       {"cf7_floor", [] { return plates(false); }},
       {"cf7_ceiling", [] { return plates(true); }},
       {"cf8_shell", shell},
       {"cf13_sky", [] { return merged(shipped("plane-sky", 1)); }},
       {"cf13_half_sky", [] { return merged(shipped("plane-half-sky", 1)); }},
       {"cf13_sun_0", [] { return merged(sun(0)); }},
       {"cf13_sun_60", [] { return merged(sun(60)); }},
       {"cf13_sun_89", [] { return merged(sun(89)); }},
       {"cf15_inside_glass", [] { return by_every_method(shipped("inside-glass", 2.25)); }}});
  for (int degrees : {0, 45, 60, 80}) {
    t.emplace_back("cf9_thin_" + std::to_string(degrees),
                   [=] { return by_every_method(thin_slab(degrees)); });
    t.emplace_back("cf9_slab_" + std::to_string(degrees), [=] {
      const std::string name = degrees ? "slab-" + std::to_string(degrees) : "slab";
      // Light that enters a pane by its edges never leaves it again.
      Case c = shipped(name, pane_transmission(degrees, 1.5));
      c.targets.front().max_depth = 1000;
      return by_every_method(c);
    });
  }
  for (int e = 1; e <= 5; ++e) {
    const double radius = std::pow(10.0, -e);
    t.emplace_back("cf5_radius_1e_" + std::to_string(e), [=] {
      return sphere_light("sphere-light-offset", radius, 16 * 0.0447214, next_event);
    });
  }
  return t;
}

}  // namespace

const std::vector<std::string>& closed_form_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> n;
    for (const auto& entry : table()) n.push_back(entry.first);
    return n;
  }();
  return names;
}

Case closed_form_case(const std::string& name) {
  for (const auto& [entry, make] : table()) {
    if (entry != name) continue;
    Case c = make();
    c.name = name;
    return c;
  }
  throw std::runtime_error("there is no case " + name);
}

}  // namespace pellucid::test

// Moves that reorder roundings: far from the origin (numerics 9, A6), turned (A6) and mirrored (31)
// the picture stays the same within its noise.
//
// Hit points are rebuilt from barycentrics and their error is bounded by their coordinates, so rays
// start off surfaces wherever these are. Positions themselves are floats: in scenes that lie far
// away they are counted from the middle, in double, before they are rounded (scene/placement.cpp).
// That costs nothing but the room for all meshes in double while a scene is read. What lies far
// apart within one scene, or was rounded in its file, is warned of (scene/distance.h).
#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "scene/distance.h"
#include "scene/load.h"
#include "stability/estimates.h"
#include "stability/exact.h"
#include "stability/measurements.h"
#include "stability/small_scenes.h"
#include "stability/temporary_file.h"

namespace pellucid::stability {
namespace {

constexpr double width = 2;  ///< of the scene, which lies on a dyadic grid

Scene moved(const Scene& scene, const glm::dvec3& scale, double sizes) {
  Scene there = scene;
  transform_points(there, scale, width * sizes * glm::dvec3(1, -1, 1));
  return there;
}

Measured pictured(const Lab& lab, const Scene& scene, const char* method) {
  // Noise of two such adds up.
  return measured(lab, scene, {method, 16, 16}, {}, 0.6 * usual_resolution);
}

Film film_of(const Lab& lab, const Scene& scene, const char* method) {
  return session_render(lab, scene, build_of(method), short_run).film;
}

/// A lump, a ball and a lamp over a floor around (x, y, y), 6 wide, as text.
std::string lump_at(double x, double y) {
  return fmt::format(R"(
    {{"type": "displaced-sphere", "material": "white", "triangles": 2000, "transform":
      [{{"rotate": {{"axis": [1, 2, 3], "degrees": 30}}}}, {{"translate": [{0}, {1}, {1}]}}]}},
    {{"type": "sphere", "material": "glass", "center": [{0}, {1}, {2}], "radius": 0.5}},
    {{"type": "disk", "material": "white", "center": [{0}, {2}, {1}], "normal": [0, -1, 0],
      "radius": 0.5, "emission": {{"radiance": 10}}}},
    {{"type": "cube", "material": "white", "center": [{0}, {3}, {1}], "size": [6, 1, 6]}})",
                     x, y, y + 1.75, y - 1.75);
}

/// Seen from near (T, T, T).
std::string scene_at(double T, const std::string& shapes) {
  return fmt::format(R"({{"version": 1,
  "camera": {{"origin": [{0}, {1}, {2}], "target": [{0}, {0}, {0}], "fov": 60}},
  "materials": {{"white": {{"type": "diffuse"}}, "glass": {{"type": "dielectric"}}}},
  "shapes": [{4}],
  "lights": [{{"type": "point", "position": [{3}, {2}, {2}], "intensity": 20}}]}})",
                     T, T + 1, T + 5, T - 2, shapes);
}

std::string lump_scene(double T) {
  return scene_at(T, lump_at(T, T));
}

Scene loaded(const std::string& text) {
  const TemporaryFile file(".json");
  std::ofstream(file.path) << text;
  return load_scene(file.path);
}

constexpr double lump_width = 6;

/// Largest distance of a vertex from where it is in a scene that lies T nearer, in sizes.
double worst_vertex(const Scene& far, const Scene& near, double T) {
  double worst = 0;
  for (std::size_t k = 0; k < near.shapes.size(); ++k) {
    const Mesh* a = std::get_if<Mesh>(&far.shapes[k].geometry);
    const Mesh* b = std::get_if<Mesh>(&near.shapes[k].geometry);
    if (!a || !b) continue;
    for (std::size_t i = 0; i < b->positions.size(); ++i)
      worst = std::max(worst, glm::length(glm::dvec3(a->positions[i]) + (far.origin - T) -
                                          glm::dvec3(b->positions[i])));
  }
  return worst / lump_width;
}

/// Scenes as they come from their files, a million of their sizes away: at whole multiples of a
/// power of two above their size they are the same to the last bit.
void measure_loading(const Lab& lab, Findings& findings) {
  constexpr double T = 8e6, odd = 8e6 / 1.3;
  const Scene near = loaded(lump_scene(0)), far = loaded(lump_scene(T));
  for (const char* method : {"path", "bdpt", "vcm"})
    findings.none(fmt::format("pixels that differ, loaded at 1e6 sizes, {}", method),
                  different_pixels(film_of(lab, near, method), film_of(lab, far, method)));
  findings.at_most("vertices loaded at 1e6 sizes, off by so much of the scene",
                   worst_vertex(loaded(lump_scene(odd)), near, odd), 0x1p-23);
  findings.require("a note, and no warning", far.notes.size() == 1 && far.warnings.empty());
  const Scene both = loaded(scene_at(0, lump_at(0, 0) + "," + lump_at(T, 0)));
  findings.require("a warning of what lies 1e6 sizes apart", !distance_warning(both).empty());
}

/// The flux of a panel of radiance 1 [CF11, CF8]: in a shell of radius R and albedo rho around it,
/// light that was reflected is the same everywhere, rho^2 flux / (4 pi^2 R^2 (1 - rho)).
void measure_flux(const Lab& lab, Findings& findings) {
  constexpr double rho = 0.5, side = 0.03, pi = 3.14159265358979323846;
  Scene scene = empty_scene(rho);
  add_shape(scene, Sphere{});
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].reflectance = Rgb(0.0);
  Shape& panel = add_shape(scene, baked(make_rectangle({-0.4, 0, 0}, {side, 0, 0}, {0, side, 0})));
  panel.material = 1;
  panel.emission = Emission{};
  for (int sides : {1, 2})
    for (double mirror : {1.0, -1.0})
      for (const char* method : {"path", "bdpt"}) {
        scene.shapes[1].emission->sides = sides;
        const Scene there = moved(scene, {1, 1, mirror}, 0);
        const Estimate all = measured_mean(lab, there, {method, 16, 16}, {});
        const Estimate direct =
            measured_mean(lab, there, {method, 16, 16}, {64, 2, 2u, MIS_BALANCE});
        compare(lab, findings,
                fmt::format("flux of a panel of {} sides{}, {}", sides,
                            mirror < 0 ? ", mirrored" : "", method),
                {all.mean - direct.mean, all.variance + direct.variance},
                rho * rho * sides * pi * side * side / (4 * pi * pi * (1 - rho)), 1e-3,
                2 * usual_resolution);
      }
}

/// A quarter turn about each axis, and one about none of them.
std::vector<std::pair<std::string, glm::dmat3>> turns() {
  std::vector<std::pair<std::string, glm::dmat3>> all;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dmat3 quarter(0);
    quarter[axis][axis] = 1;
    quarter[(axis + 1) % 3][(axis + 2) % 3] = 1;
    quarter[(axis + 2) % 3][(axis + 1) % 3] = -1;
    all.emplace_back(fmt::format("by 90 degrees about axis {}", axis), quarter);
  }
  Random random(6);
  const glm::dvec3 x = random.direction();
  const glm::dvec3 y = glm::normalize(glm::cross(x, random.direction()));
  all.emplace_back("at random", glm::dmat3(x, y, glm::cross(x, y)));
  return all;
}

}  // namespace

void far_away_is_as_near(const Lab& lab, Findings& findings) {
  const Scene here = lab.open_scene("equal-lights");
  for (const char* method : {"path", "bdpt", "vcm"}) {
    const Measured near = pictured(lab, here, method);
    for (double sizes : {1e2, 1e4})
      compare_pictures(lab, findings, fmt::format("moved by {:g} sizes, {}", sizes, method),
                       pictured(lab, moved(here, glm::dvec3(1), sizes), method), near);
    if (method == std::string("vcm")) continue;
    for (const auto& [how, turn] : turns())
      compare_pictures(lab, findings, fmt::format("turned {}, {}", how, method),
                       pictured(lab, turned(here, turn), method), near);
  }
  measure_loading(lab, findings);
}

void mirrored_is_the_same(const Lab& lab, Findings& findings) {
  measure_flux(lab, findings);
  const Scene here = lab.open_scene("equal-lights");
  for (const char* method : {"path", "bdpt"}) {
    const Measured plain = pictured(lab, here, method);
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 scale(1);
      scale[axis] = -1;
      compare_pictures(lab, findings, fmt::format("mirrored along axis {}, {}", axis, method),
                       pictured(lab, moved(here, scale, 0), method), plain);
    }
  }
}

}  // namespace pellucid::stability

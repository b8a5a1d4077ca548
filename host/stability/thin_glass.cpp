// Thin glass (numerics 15): a pane lets through what it must down to a millionth of its size, a
// hollow ball to four of its radius; of thinner ones loading warns. Glass with water and air in it
// shows all of the sky.
//
// Rays start off a surface by a bound of its rounding (geom/surface.h). Where glass is thinner than
// that, one that enters it starts beyond its other side; naive code, which nudges by a constant,
// jumps over 1e-4 of whatever unit there is. Warnings cost some sums for each face of a pane when a
// scene is loaded, and a sort of its balls (scene/thin_shells.h); kernels know nothing of it.
//
// Naive code has a stack of the media that a ray is in, which overflows and goes negative. Here an
// index is that of the inside over the outside, so that there is none: where two media meet is one
// surface. Solids that overlap, of which priorities tell which one counts, are not applicable.
#include "scene/thin_glass.h"

#include <fmt/format.h>

#include "scene/thin_shells.h"
#include "stability/closed_forms.h"
#include "stability/estimates.h"
#include "stability/measurements.h"
#include "stability/small_scenes.h"

namespace pellucid::stability {
namespace {

/// CF9's pane, 40 wide, of another thickness.
Scene pane_of(const Lab& lab, double thickness) {
  Scene scene = lab.open_scene("slab");
  for (Shape& shape : scene.shapes)
    if (shape.name == "pane")
      for (glm::vec3& p : std::get<Mesh>(shape.geometry).positions)
        p.z = p.z < -0.06f ? float(-thickness) : 0.0f;
  return scene;
}

/// A lamp that fills one half of the world, seen from the middle of a hollow ball of glass of
/// radius 1: what the shell sends back comes round again from its other side.
Scene shell_of(double thickness, double place) {
  const glm::dvec3 center(place);
  Scene scene = empty_scene(0.0);
  add_shape(scene, Disk{center - glm::dvec3(0, 0, 3), {0, 0, 1}, 100.0}).emission = Emission{};
  for (bool outer : {true, false}) {
    Material glass;
    glass.kind = MaterialKind::dielectric;
    glass.ior = outer ? 1.5 : 1 / 1.5;
    scene.materials.push_back(glass);
    Shape& shape = add_shape(scene, Sphere{center, outer ? 1.0 : 1.0 - thickness});
    shape.material = int(scene.materials.size() - 1);
    shape.name = outer ? "outside" : "inside";
  }
  scene.camera.origin = center;
  scene.camera.fov = 90;  // rays are moved off a ball by most along its diagonals
  return scene;
}

/// Around the origin rays start up to 1.6e-6 radii off a ball, and its shell is right down to 2e-6;
/// from 1.5e-6 on half of the light is lost. Around (8, 8, 8), it is ten times as much. From twice
/// those distances on there is no warning.
void measure_shells(const Lab& lab, Findings& findings) {
  const double through = pane_transmission(0, 1.5),
               value = through / (1 - (1 - through) * (1 - through));
  struct Shell {
    double place, thickness;
    bool warned;
  };
  for (const Shell& shell : {Shell{0, 1e-1, false},
                             {0, 1e-2, false},
                             {0, 1e-3, false},
                             {0, 1e-4, false},
                             {0, 1e-5, false},
                             {0, 4e-6, false},
                             {0, 2e-6, true},
                             {0, 1e-6, true},
                             {0, 1e-7, true},
                             {8, 3e-5, false},
                             {8, 1e-5, true}}) {
    const Scene scene = shell_of(shell.thickness, shell.place);
    const std::string what =
        fmt::format("shell of {:g} radii around {:g}", shell.thickness, shell.place);
    const std::string warning = thin_shell_warning(scene);
    if (shell.warned) {
      findings.require("a warning of a " + what, !warning.empty());
      findings.warning = warning;
      continue;
    }
    findings.require("no warning of a " + what, warning.empty());
    for (const char* method : {"path", "bdpt", "vcm"})
      compare(lab, findings, fmt::format("{}, {}", what, method),
              measured_mean(lab, scene, {method, 16, 16}, {64, 1, long_enough, MIS_BALANCE}), value,
              1e-5);
  }
}

/// A ball of glass, in it one of water, and in that a bubble: under a sky that is 1 everywhere each
/// pixel is 1 [CF3].
void measure_media(const Lab& lab, Findings& findings) {
  Scene scene = empty_scene();
  scene.lights.push_back(ConstantEnvironment{Rgb(1.0)});
  constexpr double air = 1, water = 1.33, pane = 1.5;
  struct Layer {
    double radius, inside, outside;
  };
  for (const Layer& layer : {Layer{1, pane, air}, {0.8, water, pane}, {0.5, air, water}}) {
    Material material;
    material.kind = MaterialKind::dielectric;
    material.ior = layer.inside / layer.outside;
    scene.materials.push_back(material);
    add_shape(scene, Sphere{{0, 0, 0}, layer.radius}).material = int(scene.materials.size() - 1);
  }
  scene.camera.origin = {0, 0, 3};
  scene.camera.fov = 38;  // hardly more than the ball
  constexpr double slack = 1e-5, resolution = 0.002;
  for (const char* method : {"naive", "path", "bdpt", "vcm"})
    compare(lab, findings, fmt::format("glass, water and air under a sky, {}", method),
            measured_mean(lab, scene, {method, 16, 16}, {256, 1, long_enough, MIS_BALANCE}), 1,
            slack, resolution);
}

}  // namespace

void thin_panes_let_light_through(const Lab& lab, Findings& findings) {
  constexpr double size = 40;
  constexpr uint depth = 1000;  // light that enters a pane by its edges never leaves it again
  for (double part : {2e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    const Scene scene = pane_of(lab, size * part);
    for (const char* method : {"path", "bdpt", "vcm"})
      compare(lab, findings, fmt::format("pane of {:g} sizes, {}", part, method),
              measured_mean(lab, scene, {method, 16, 16}, {64, 1, depth, MIS_BALANCE}),
              pane_transmission(0, 1.5), 1e-5);
    findings.require(fmt::format("no warning of {:g} sizes", part),
                     thin_glass_warning(scene).empty());
  }
  measure_shells(lab, findings);
  measure_media(lab, findings);
  const std::string pane = thin_glass_warning(pane_of(lab, size * 1e-7));
  findings.require("a warning of 1e-7 sizes", !pane.empty());
  findings.warning = pane + "; " + findings.warning;
}

}  // namespace pellucid::stability

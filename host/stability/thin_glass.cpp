// Thin glass (numerics 15): a pane lets through what it must down to a hundred-thousandth of its
// size; thinner ones, which rays may jump over, are warned of when a scene is loaded. Nested media,
// the other half of that case, there are none: an index is that of the inside over the outside.
#include "scene/thin_glass.h"

#include <fmt/format.h>

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
void measure_shells(const Lab& lab, Findings& findings) {
  const double through = pane_transmission(0, 1.5),
               value = through / (1 - (1 - through) * (1 - through));
  for (double thickness : {1e-1, 1e-3, 1e-5}) {
    Scene scene = empty_scene(0.0);
    add_shape(scene, Disk{{0, 0, -3}, {0, 0, 1}, 100.0}).emission = Emission{};
    for (bool outer : {true, false}) {
      Material glass;
      glass.kind = MaterialKind::dielectric;
      glass.ior = outer ? 1.5 : 1 / 1.5;
      scene.materials.push_back(glass);
      add_shape(scene, Sphere{{0, 0, 0}, outer ? 1.0 : 1.0 - thickness}).material =
          int(scene.materials.size() - 1);
    }
    scene.camera.fov = 0.1;
    for (const char* method : {"path", "bdpt", "vcm"})
      compare(lab, findings, fmt::format("shell of {:g} radii, {}", thickness, method),
              measured_mean(lab, scene, {method, 16, 16}, {64, 1, long_enough, MIS_BALANCE}), value,
              1e-5);
  }
}

}  // namespace

void thin_panes_let_light_through(const Lab& lab, Findings& findings) {
  constexpr double size = 40;
  constexpr uint depth = 1000;  // light that enters a pane by its edges never leaves it again
  for (double part : {2e-2, 1e-3, 1e-4, 1e-5}) {
    const Scene scene = pane_of(lab, size * part);
    for (const char* method : {"path", "bdpt", "vcm"})
      compare(lab, findings, fmt::format("pane of {:g} sizes, {}", part, method),
              measured_mean(lab, scene, {method, 16, 16}, {64, 1, depth, MIS_BALANCE}),
              pane_transmission(0, 1.5), 1e-5);
    findings.require(fmt::format("no warning of {:g} sizes", part),
                     thin_glass_warning(scene).empty());
  }
  measure_shells(lab, findings);
  findings.warning = thin_glass_warning(pane_of(lab, size * 1e-7));
  findings.require("a warning of 1e-7 sizes", !findings.warning.empty());
}

}  // namespace pellucid::stability

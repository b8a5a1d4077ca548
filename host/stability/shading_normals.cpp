// Normals that disagree with the facets (numerics 8): methods that walk from the lights converge to
// what those converge to that walk from the camera.
//
// Scattering by interpolated normals is not symmetric: walks from a light carry the factor
// |wo.ns| |wi.ng| / (|wo.ng| |wi.ns|) [Veach97, 5.3], in their own bounces and in connections: two
// dot products and a division per vertex. What lobes send below the facet is lost, by all methods
// alike: 5 % of what a white ball of 64 facets should send back, 0.1 % with 1000. Loading tells of
// meshes that lose more than 2 % (scene/coarse_normals.h).
#include <fmt/format.h>

#include <algorithm>

#include "scene/coarse_normals.h"
#include "stability/estimates.h"
#include "stability/measurements.h"
#include "stability/small_scenes.h"

namespace pellucid::stability {
namespace {

/// A white ball under a uniform sky, which should not be seen: what interpolated normals lose. At
/// an outline of facets they look away, and all but the light at grazing angles is lost.
void measure_furnace(const Lab& lab, Findings& findings) {
  DisplacedSphere ball;
  ball.triangles = 1000;
  ball.amplitude = 0;
  Scene scene = empty_scene(1.0);
  add_shape(scene, baked(generate(ball)));
  Mesh& mesh = std::get<Mesh>(scene.shapes[0].geometry);
  for (const glm::vec3& p : mesh.positions) mesh.normals.push_back(glm::normalize(p));
  scene.lights = {ConstantEnvironment{}};
  scene.camera.origin = {0, 0, 6};
  scene.camera.fov = 22;
  for (const char* method : {"path", "bdpt"}) {
    const Measured m =
        Renderer(lab, scene, {method, 24, 24}).measure({lab.count(4096), 1, {}, MIS_BALANCE});
    double loss = 0, gain = 0;
    for (const auto& p : m.pixels) {
      const double noise = 4.5 * p[0].error();
      loss = std::max(loss, 1 - p[0].mean - noise), gain = std::max(gain, p[0].mean - 1 - noise);
    }
    findings.at_most(fmt::format("white ball of 1000 facets: loss of a pixel, {}", method), loss,
                     0.02);
    findings.at_most(fmt::format("white ball of 1000 facets: gain of a pixel, {}", method), gain,
                     1e-5);
  }
  findings.require("no note of 1000 facets", coarse_normals_note(scene).empty());
}

}  // namespace

void shading_normals_are_symmetric(const Lab& lab, Findings& findings) {
  const Scene scene = lab.open_scene("equal-shading");
  // Noise of two such adds up.
  const auto means = [&](const Scene& of, const char* method) {
    return measured_means(lab, of, {method, 16, 16}, {}, 0.6 * usual_resolution);
  };
  const std::array<Estimate, 3> expected = means(scene, "path");
  for (const char* method : {"nee", "bdpt", "light"})
    compare_means(lab, findings, fmt::format("two balls of 64 facets beside path, {}", method),
                  means(scene, method), expected);
  for (const char* method : {"sppm", "vcm"}) {
    Build build{method, 16, 16};
    build.light_paths = 1 << 12;
    build.radius = 0.02, build.radius_alpha = 1;  // so small that discs hardly hang over edges
    compare_means(lab, findings, fmt::format("two balls of 64 facets beside path, {}", method),
                  measured_means(lab, scene, build, {}, 0.6 * usual_resolution), expected);
  }
  measure_furnace(lab, findings);
  findings.warning = coarse_normals_note(scene);
  findings.require("a note of 64 facets", !findings.warning.empty());
  // Without interpolated normals there is nothing to disagree: the same code, the same check.
  Scene flat = scene;
  for (Shape& shape : flat.shapes)
    if (Mesh* mesh = std::get_if<Mesh>(&shape.geometry)) mesh->normals.clear();
  compare_means(lab, findings, "the same with flat facets, light beside path", means(flat, "light"),
                means(flat, "path"));
}

}  // namespace pellucid::stability

// Normals that disagree with the facets (numerics 8): methods that walk from the lights converge to
// what those converge to that walk from the camera.
//
// Scattering by interpolated normals is not symmetric: walks from a light carry the factor
// |wo.ns| |wi.ng| / (|wo.ng| |wi.ns|) [Veach97, 5.3], in their own bounces and in connections: two
// dot products and a division per vertex. What lobes send below the facet is lost in naive code, 5
// % of a white ball of 64 facets and up to 35 % of a pixel at its outline; here the facet mirrors
// it back (kernels/transport/facet.h), which costs a second evaluation of the lobe in the wedge
// between both planes.
#include <fmt/format.h>

#include <algorithm>

#include "stability/estimates.h"
#include "stability/measurements.h"
#include "stability/small_scenes.h"

namespace pellucid::stability {
namespace {

Scene ball_under_sky(const Material& paint, int facets) {
  DisplacedSphere ball;
  ball.triangles = facets;
  ball.amplitude = 0;
  Scene scene = empty_scene(1.0);
  scene.materials[0] = paint;
  add_shape(scene, baked(generate(ball)));
  Mesh& mesh = std::get<Mesh>(scene.shapes[0].geometry);
  for (const glm::vec3& p : mesh.positions) mesh.normals.push_back(glm::normalize(p));
  scene.lights = {ConstantEnvironment{}};
  scene.camera.origin = {0, 0, 6};
  scene.camera.fov = 22;
  return scene;
}

/// A white ball under a uniform sky, which should not be seen. `naive` weighs nothing, so that each
/// of its samples is 1 but for rounding; the others agree in the mean. One of rough plastic beside
/// a round one: its lobes lose energy of their own where they are grazed, which facets are on bands
/// that vanish with their size.
void measure_furnace(const Lab& lab, Findings& findings) {
  Material paint;
  paint.reflectance = Rgb(1.0);
  const Scene white = ball_under_sky(paint, 64);
  const Picture picture =
      Renderer(lab, white, {"naive", 24, 24}).render({lab.count(256), 1, {}, MIS_BALANCE});
  double darkest = 1, brightest = 0;
  for (const auto& p : picture.pixels)
    darkest = std::min(darkest, p[0].mean), brightest = std::max(brightest, p[0].mean);
  findings.at_most("white ball of 64 facets: loss of a pixel, naive", 1 - darkest, 1e-5);
  findings.at_most("white ball of 64 facets: gain of a pixel, naive", brightest - 1, 1e-5);
  for (const char* method : {"nee", "path", "reference", "light", "bdpt", "vcm"})
    compare(lab, findings, fmt::format("white ball of 64 facets, {}", method),
            measured_mean(lab, white, {method, 24, 24}, {}), 1, 0);
  paint.kind = MaterialKind::plastic;
  paint.alpha = paint.roughness = 0.3;
  Scene round = ball_under_sky(paint, 64);
  round.shapes[0].geometry = Sphere{{0, 0, 0}, 1};
  const auto mean = [&](const Scene& scene) {
    return Renderer(lab, scene, {"naive", 24, 24})
        .measure({lab.count(1024), 1, {}, MIS_BALANCE})
        .image[0]
        .mean;
  };
  const double expected = mean(round);
  for (const auto& [facets, bound] : {std::pair{64, 0.02}, {1000, 0.002}})
    findings.at_most(fmt::format("plastic ball of {} facets: loss of the picture", facets),
                     std::abs(1 - mean(ball_under_sky(paint, facets)) / expected), bound);
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
  // Without interpolated normals there is nothing to disagree: the same code, the same check.
  Scene flat = scene;
  for (Shape& shape : flat.shapes)
    if (Mesh* mesh = std::get_if<Mesh>(&shape.geometry)) mesh->normals.clear();
  compare_means(lab, findings, "the same with flat facets, light beside path", means(flat, "light"),
                means(flat, "path"));
}

}  // namespace pellucid::stability

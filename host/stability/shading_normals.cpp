// Normals that disagree with the facets (numerics 8): methods that walk from the lights converge to
// what those converge to that walk from the camera.
//
// Scattering by interpolated normals is not symmetric: walks from a light carry the factor
// |wo.ns| |wi.ng| / (|wo.ng| |wi.ns|) [Veach97, 5.3], in their own bounces and in connections: two
// dot products and a division per vertex.
#include <fmt/format.h>

#include <algorithm>

#include "stability/estimates.h"
#include "stability/measurements.h"

namespace pellucid::stability {

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
  // Without interpolated normals there is nothing to disagree: the same code, the same check.
  Scene flat = scene;
  for (Shape& shape : flat.shapes)
    if (Mesh* mesh = std::get_if<Mesh>(&shape.geometry)) mesh->normals.clear();
  compare_means(lab, findings, "the same with flat facets, light beside path", means(flat, "light"),
                means(flat, "path"));
}

}  // namespace pellucid::stability

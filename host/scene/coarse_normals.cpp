// The share of light that facets under interpolated normals lose.
#include "scene/coarse_normals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pellucid {
namespace {

struct Loss {
  double share = 0;    ///< of the light that a matte surface sends back, mean over the area
  double degrees = 0;  ///< largest angle between a normal and its facet's
};

/// A lobe about the shading normal loses what it sends below the facet: of a matte one, seen from
/// straight above, (1 - cos) / 2 for the angle between the normals.
Loss loss_of(const Mesh& mesh) {
  double lost = 0, area = 0, least = 1;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 p = mesh.positions[t.x];
    const glm::dvec3 cross =
        glm::cross(glm::dvec3(mesh.positions[t.y]) - p, glm::dvec3(mesh.positions[t.z]) - p);
    const double size = glm::length(cross);
    if (!(size > 0)) continue;
    area += size;
    for (int i = 0; i < 3; ++i) {
      // Which side a normal is on does not matter: it is turned to where it is seen from.
      const double cosine = std::abs(glm::dot(cross, glm::dvec3(mesh.normals[t[i]]))) / size;
      lost += size * (1 - std::min(cosine, 1.0)) / 6;
      least = std::min(least, cosine);
    }
  }
  if (!(area > 0)) return {};
  return {lost / area, std::acos(least) * 180 / 3.14159265358979323846};
}

}  // namespace

std::string coarse_normals_note(const Scene& scene) {
  // What a ball of some 150 facets loses; one of 1000 loses 0.3 %.
  constexpr double visible = 0.02;
  std::string text;
  double most = visible;
  for (const Shape& shape : scene.shapes) {
    const Mesh* mesh = std::get_if<Mesh>(&shape.geometry);
    if (!mesh || mesh->normals.empty()) continue;
    const Loss loss = loss_of(*mesh);
    if (!(loss.share > most)) continue;
    most = loss.share;
    text = fmt::format(
        "{}: normals are up to {:.0f} degrees off its {} facets, so that about {:.1f} % of the "
        "light "
        "that it reflects is lost, and more at its outline; divide it finer, or set \"smooth\" to "
        "false",
        shape.name, loss.degrees, mesh->triangles.size(), 100 * loss.share);
  }
  return text;
}

}  // namespace pellucid

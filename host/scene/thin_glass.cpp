// The thickness of flat glass across each of its faces.
#include "scene/thin_glass.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace pellucid {
namespace {

/// Of a mesh that is looked at: panes and boxes.
constexpr std::size_t most_faces = 64;

/// Rays start off a surface by up to 10 roundoffs of its coordinates and 8 of its extent
/// (shared/limits.h), here twice that.
double least_thickness(double reach, double extent) {
  return 0x1p-24 * (20 * reach + 16 * extent);
}

double thickness(const Mesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    const glm::dvec3 n = glm::normalize(glm::cross(b - a, c - a));
    double low = 0, high = 0;
    for (const glm::vec3& p : mesh.positions) {
      const double x = glm::dot(glm::dvec3(p) - a, n);
      low = std::min(low, x), high = std::max(high, x);
    }
    least = std::min(least, high - low);
  }
  return least;
}

}  // namespace

std::string thin_glass_warning(const Scene& scene) {
  for (const Shape& shape : scene.shapes) {
    const Mesh* mesh = std::get_if<Mesh>(&shape.geometry);
    const Material& material = scene.materials[std::size_t(shape.material)];
    if (!mesh || material.kind != MaterialKind::dielectric || mesh->triangles.size() > most_faces)
      continue;
    glm::dvec3 low(mesh->positions[0]), high = low;
    for (const glm::vec3& p : mesh->positions)
      low = glm::min(low, glm::dvec3(p)), high = glm::max(high, glm::dvec3(p));
    const glm::dvec3 far = glm::max(glm::abs(low), glm::abs(high)), size = high - low;
    const double needed =
        least_thickness(std::max({far.x, far.y, far.z}), std::max({size.x, size.y, size.z}));
    const double thick = thickness(*mesh);
    // A single sheet has no thickness by intent: what lies behind it is all glass.
    if (thick > 0 && thick < needed)
      return fmt::format(
          "the glass of {} is {:.2g} thick, which rays that enter it may miss; make it {:.2g} "
          "thick "
          "or more, or of \"thin-dielectric\"",
          shape.name, thick, needed);
  }
  return "";
}

}  // namespace pellucid

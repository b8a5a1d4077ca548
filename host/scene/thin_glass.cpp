// The thickness of flat glass across each of its faces.
#include "scene/thin_glass.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "shared/limits.h"

namespace pellucid {
namespace {

/// Of a mesh that is looked at: panes and boxes. Of curved or finer ones, and of one mesh within
/// another, nothing is told.
constexpr std::size_t most_faces = 64;

bool has_kind(const Material& material, MaterialKind kind) {
  return material.kind == kind ||
         std::any_of(material.parts.begin(), material.parts.end(),
                     [&](const Material& part) { return has_kind(part, kind); });
}

struct Thickness {
  double is = 0, needed = 0;
};

/// Twice what rays start off a face by at most (geom/triangle_point.h), for a start is
/// off its plane by as much again when all errors add up. Kernels count the extents of two edges.
double least_thickness(const glm::dvec3& n, const glm::dvec3& reach, double extent) {
  const double bound = double(POINT_ERROR_ULPS) * glm::dot(glm::abs(n), reach) +
                       double(EXTENT_ERROR_ULPS) * 2 * extent;
  return 2 * double(UNIT_ROUNDOFF) * bound;
}

/// Across the first face where it is too little, or across the last one. A single sheet has no
/// thickness by intent: what lies behind it is all glass.
Thickness thickness(const Mesh& mesh) {
  glm::dvec3 low(mesh.positions[0]), high = low;
  for (const glm::vec3& p : mesh.positions)
    low = glm::min(low, glm::dvec3(p)), high = glm::max(high, glm::dvec3(p));
  const glm::dvec3 reach = glm::max(glm::abs(low), glm::abs(high)), size = high - low;
  Thickness found;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    const glm::dvec3 n = glm::normalize(glm::cross(b - a, c - a));
    double below = 0, above = 0;
    for (const glm::vec3& p : mesh.positions) {
      const double x = glm::dot(glm::dvec3(p) - a, n);
      below = std::min(below, x), above = std::max(above, x);
    }
    found = {above - below, least_thickness(n, reach, std::max({size.x, size.y, size.z}))};
    if (found.is > 0 && found.is < found.needed) break;
  }
  return found;
}

}  // namespace

bool lets_rays_in(const Material& material) {
  return has_kind(material, MaterialKind::dielectric) ||
         has_kind(material, MaterialKind::thin_dielectric);
}

std::string thin_glass_warning(const Scene& scene) {
  for (const Shape& shape : scene.shapes) {
    const Mesh* mesh = std::get_if<Mesh>(&shape.geometry);
    const Material& material = scene.materials[std::size_t(shape.material)];
    if (!mesh || !has_kind(material, MaterialKind::dielectric) ||
        mesh->triangles.size() > most_faces)
      continue;
    const Thickness thick = thickness(*mesh);
    if (thick.is > 0 && thick.is < thick.needed)
      return fmt::format(
          "the glass of {} is {:.2g} thick, which rays that enter it may miss; make it {:.2g} "
          "thick "
          "or more, or of \"thin-dielectric\"",
          shape.name, thick.is, thick.needed);
  }
  return "";
}

}  // namespace pellucid

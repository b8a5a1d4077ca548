// Needles, by the ratio of their longest edge to their height over it.
#include "scene/needles.h"

#include <fmt/format.h>

#include <algorithm>

namespace pellucid {
namespace {

/// Up to 1:1e5 no ray is lost, at 1:1e6 1 in 1e4 where they start between needles
/// (stability case degenerate).
constexpr double longest = 3e4;

double squared(const glm::dvec3& v) {
  return glm::dot(v, v);
}

bool is_needle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double edge2 = std::max({squared(b - a), squared(c - a), squared(c - b)});
  // Length over height is edge^2 over twice the area; squares spare the roots.
  return edge2 * edge2 > longest * longest * squared(glm::cross(b - a, c - a));
}

}  // namespace

std::string needle_warning(const Scene& scene) {
  for (const Shape& shape : scene.shapes) {
    const Mesh* mesh = std::get_if<Mesh>(&shape.geometry);
    if (!mesh) continue;
    const auto count =
        std::count_if(mesh->triangles.begin(), mesh->triangles.end(), [&](const glm::uvec3& t) {
          return is_needle(mesh->positions[t.x], mesh->positions[t.y], mesh->positions[t.z]);
        });
    if (count > 0)
      return fmt::format(
          "{} has {} triangles that are more than {:g} times as long as wide: light may leak "
          "between them; divide them along their length",
          shape.name, count, longest);
  }
  return "";
}

}  // namespace pellucid

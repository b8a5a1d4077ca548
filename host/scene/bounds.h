// Boxes in double around what a scene is made of.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <limits>

#include "scene/scene.h"

namespace pellucid {

struct Bounds {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high = -low;

  void add(const glm::dvec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
  void add(const Bounds& b) { low = glm::min(low, b.low), high = glm::max(high, b.high); }
  /// Largest extent.
  double size() const {
    const glm::dvec3 extent = high - low;
    return std::max({extent.x, extent.y, extent.z});
  }
  /// Largest |coordinate|.
  double reach() const {
    const glm::dvec3 far = glm::max(glm::abs(low), glm::abs(high));
    return std::max({far.x, far.y, far.z});
  }
};

template <typename Points>
Bounds bounds_of_points(const Points& points) {
  Bounds b;
  for (const auto& p : points) b.add(glm::dvec3(p));
  return b;
}

/// Of a disk: of the sphere around it.
inline Bounds bounds_of(const Shape& shape) {
  if (const Mesh* mesh = std::get_if<Mesh>(&shape.geometry))
    return bounds_of_points(mesh->positions);
  const auto around = [](const auto& round) {
    return Bounds{round.center - round.radius, round.center + round.radius};
  };
  const Sphere* sphere = std::get_if<Sphere>(&shape.geometry);
  return sphere ? around(*sphere) : around(std::get<Disk>(shape.geometry));
}

}  // namespace pellucid

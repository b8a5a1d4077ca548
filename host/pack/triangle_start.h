// Where rays may start that leave a point of a triangle: for benchmarks and measurements.
#pragma once

#include <glm/vec3.hpp>

#include "pack/pack.h"

namespace pellucid {

struct TriangleStart {
  glm::vec3 p, ng;  ///< the point and its unit geometric normal
  float offset;     ///< how far off p along ng rays start, on their own side

  /// Origin of a ray along w.
  glm::vec3 towards(const glm::vec3& w) const;
};

/// At weights b1, b2 of the second and third corner of triangle `prim`: the kernels' code, and
/// their bits in `--float strict` on devices that round divisions and roots correctly.
TriangleStart triangle_start(const PackedScene& scene, uint prim, float b1, float b2);

}  // namespace pellucid

// Compiles the kernels' own geom/triangle_point.h in float, so that there is one formula.
#include "pack/triangle_start.h"

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>

#define PELLUCID_REAL float
#define PELLUCID_REAL_IS_FLOAT
namespace pellucid::kernel_code {
#include "geom/triangle_point.h"
}

namespace pellucid {
namespace {

kernel_code::real3 corner(const PackedScene& scene, uint vertex) {
  return kernel_code::load3(scene.positions[vertex]);
}

glm::vec3 vec(const kernel_code::real3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

TriangleStart triangle_start(const PackedScene& scene, uint prim, float b1, float b2) {
  const Triangle& t = scene.triangles[prim];
  const kernel_code::TrianglePoint at = kernel_code::point_of_triangle(
      corner(scene, t.v0), corner(scene, t.v1), corner(scene, t.v2), b1, b2);
  return {vec(at.p), vec(at.ng), at.offset};
}

glm::vec3 TriangleStart::towards(const glm::vec3& w) const {
  return p + ng * (glm::dot(ng, w) < 0.0f ? -offset : offset);
}

}  // namespace pellucid

// Compiles the kernels' own geom/triangle_point.h in float, so that there is one formula.
#include "pack/triangle_start.h"

// What kernel headers include themselves has to be known before, outside the namespace.
#include <cmath>
#include <cstring>
#include <limits>

#include "shared/layout.h"
#include "shared/limits.h"

#define PELLUCID_REAL float
#define PELLUCID_REAL_IS_FLOAT
namespace pellucid::kernel_code {
#include "geom/ray.h"
#include "geom/triangle_point.h"
}  // namespace pellucid::kernel_code

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
  const auto real3 = [](const glm::vec3& v) { return kernel_code::real3{v.x, v.y, v.z}; };
  return vec(kernel_code::spawn_origin(real3(p), real3(ng), offset, real3(w)));
}

}  // namespace pellucid

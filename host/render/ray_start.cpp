// Compiles the kernels' own geom/triangle_point.h in float, so that there is one formula.
#include "render/ray_start.h"

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

RayStart ray_start(const PackedScene& scene, const TraceHit& hit) {
  const Triangle& t = scene.triangles[hit.prim];
  const kernel_code::TrianglePoint at = kernel_code::point_of_triangle(
      corner(scene, t.v0), corner(scene, t.v1), corner(scene, t.v2), hit.b1, hit.b2);
  return {vec(at.p), vec(at.ng), at.offset};
}

RayStart naive_ray_start(const PackedScene& scene, const TraceRay& ray, const TraceHit& hit) {
  RayStart s = ray_start(scene, hit);
  s.p = {std::fma(hit.t, ray.dx, ray.ox), std::fma(hit.t, ray.dy, ray.oy),
         std::fma(hit.t, ray.dz, ray.oz)};
  s.offset = 0;
  s.epsilon = NAIVE_EPSILON;
  return s;
}

TraceRay RayStart::towards(const glm::vec3& w) const {
  const glm::vec3 o = p + w * epsilon + ng * (glm::dot(ng, w) < 0.0f ? -offset : offset);
  return {o.x, o.y, o.z, std::numeric_limits<float>::max(), w.x, w.y, w.z, 0.0f};
}

}  // namespace pellucid

// Spheres from afar (numerics 29).
//
// b^2 - 4 a c cancels as the square of distance over radius. Here the ray's origin first moves to
// the point nearest the centre, and the distance from the centre to the ray decides
// (geom/quadric.h): a handful of operations more.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "stability/measurements.h"

namespace pellucid::stability {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Parallel rays across a square of 3 x 3: the share of hits is pi / 9.
std::vector<TraceRay> raster(const glm::dvec3& d, double distance, int n) {
  const glm::dvec3 s = glm::normalize(glm::cross(d, {0.3, 1, 0.2})), t = glm::cross(d, s);
  std::vector<TraceRay> rays;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k)
      rays.push_back(ray_along(
          (3 * (i + 0.5) / n - 1.5) * s + (3 * (k + 0.5) / n - 1.5) * t - distance * d, d));
  return rays;
}

}  // namespace

void spheres_stay_round(const Lab& lab, Findings& findings) {
  Scene scene = empty_scene();
  add_shape(scene, Sphere{});
  TracedScene traced(lab, scene);
  Random random(2);
  const auto n = int(1000 * std::sqrt(lab.effort));
  for (double distance : {2.0, 1e2, 1e4, 1e6}) {
    const glm::dvec3 d(glm::vec3(random.direction()));
    const std::vector<TraceRay> rays = raster(d, distance, n);
    std::size_t hits = 0;
    double off = 0;
    const std::vector<TraceHit> found = traced.closest(rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (found[i].prim == NONE) continue;
      ++hits;
      const glm::dvec3 p = origin_of(rays[i]) + double(found[i].t) * direction_of(rays[i]);
      off = std::max(off, std::abs(glm::length(p) - 1));
    }
    // 0.1 %, and at 1e6 half an ulp of the origin (1/32) that moves rays in and out.
    findings.at_most(
        fmt::format("area of the silhouette from {:g} radii: relative error", distance),
        std::abs(9.0 * double(hits) / double(rays.size()) / pi - 1), distance > 1e5 ? 0.01 : 1e-3);
    // Distances have ulps of the distance; the surface point itself is projected on the sphere.
    findings.at_most(
        fmt::format("hits off the sphere from {:g} radii, in roundoffs of the distance", distance),
        off / (0x1p-24 * (1 + distance)), 32);
  }
}

}  // namespace pellucid::stability

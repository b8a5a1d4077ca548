// Brute force in double.
#include "stability/brute_force.h"

#include <algorithm>
#include <cmath>

namespace pellucid::stability {
namespace {

glm::dvec3 vec(const F4& v) {
  return {v.x, v.y, v.z};
}

/// Moeller-Trumbore; the outline moves by comparing edge distances with `margin`.
double triangle_distance(const PackedScene& scene, const Triangle& tri, const glm::dvec3& o,
                         const glm::dvec3& d, double margin) {
  const glm::dvec3 v0 = vec(scene.positions[tri.v0]);
  const glm::dvec3 e1 = vec(scene.positions[tri.v1]) - v0, e2 = vec(scene.positions[tri.v2]) - v0;
  const glm::dvec3 p = glm::cross(d, e2);
  const double det = glm::dot(e1, p);
  if (det == 0.0) return -1.0;
  const glm::dvec3 s = o - v0, q = glm::cross(s, e1);
  const double b1 = glm::dot(s, p) / det, b2 = glm::dot(d, q) / det;
  // A weight times its height is the distance from the opposite edge, seen along the ray.
  const double area = std::abs(det);
  const auto inside = [&](double b, const glm::dvec3& edge) {
    return margin == 0.0 ? b >= 0.0 : b * area >= -margin * glm::length(glm::cross(edge, d));
  };
  if (!inside(b1, e2) || !inside(b2, e1) || !inside(1 - b1 - b2, e2 - e1)) return -1.0;
  const double t = glm::dot(e2, q) / det;
  return t > 0.0 ? t : -1.0;
}

double sphere_distance(const Quadric& q, const glm::dvec3& o, const glm::dvec3& d, double margin) {
  const glm::dvec3 oc = o - vec(q.center_radius);
  const double r = q.center_radius.w + margin;
  const double b = glm::dot(oc, d), c = glm::dot(oc, oc) - r * r;
  const double discriminant = b * b - c;
  if (discriminant < 0.0) return -1.0;
  const double root = std::sqrt(discriminant);
  return -b - root > 0.0 ? -b - root : (-b + root > 0.0 ? -b + root : -1.0);
}

double disk_distance(const Quadric& q, const glm::dvec3& o, const glm::dvec3& d, double margin) {
  const glm::dvec3 c = vec(q.center_radius), n = vec(q.normal);
  const double cosine = glm::dot(d, n);
  if (cosine == 0.0) return -1.0;
  const double t = glm::dot(c - o, n) / cosine;
  // Margins are across the ray; on the disk they grow by 1/|cosine|.
  const double r = q.center_radius.w + margin / std::abs(cosine);
  return t > 0.0 && r > 0.0 && glm::length(o + t * d - c) <= r ? t : -1.0;
}

}  // namespace

double distance_to(const PackedScene& scene, uint prim, const glm::dvec3& o, const glm::dvec3& d,
                   double margin) {
  if (prim < scene.info.triangle_count)
    return triangle_distance(scene, scene.triangles[prim], o, d, margin);
  const Quadric& q = scene.quadrics[prim - scene.info.triangle_count];
  return q.kind == QUADRIC_SPHERE ? sphere_distance(q, o, d, margin)
                                  : disk_distance(q, o, d, margin);
}

BruteHit brute_force_trace(const PackedScene& scene, const glm::dvec3& o, const glm::dvec3& d) {
  const bool quadrics = scene.features.has(FEAT_SPHERES) || scene.features.has(FEAT_DISKS);
  const uint count = scene.info.triangle_count + (quadrics ? uint(scene.quadrics.size()) : 0u);
  BruteHit best;
  for (uint prim = 0; prim < count; ++prim) {
    const double t = distance_to(scene, prim, o, d, 0.0);
    if (t > 0.0 && (best.prim == NONE || t < best.t)) best = {t, prim};
  }
  return best;
}

}  // namespace pellucid::stability

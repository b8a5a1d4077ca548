// Flat triangles, rays and balls by formulas of their own.
#include "support/facets.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pellucid::test {
namespace {

double cross2(const glm::dvec2& p, const glm::dvec2& q) {
  return p.x * q.y - p.y * q.x;
}

/// Area, signed by the turn from p to q, that the triangle of the origin, p and q has in common
/// with the disc of radius r around the origin: a triangle where the side lies inside, sectors
/// beside it.
double wedge_in_disc(const glm::dvec2& p, const glm::dvec2& q, double r) {
  const auto sector = [&](const glm::dvec2& u, const glm::dvec2& v) {
    return 0.5 * r * r * std::atan2(cross2(u, v), glm::dot(u, v));
  };
  const glm::dvec2 d = q - p;
  const double length2 = glm::dot(d, d), middle = -glm::dot(p, d) / length2;
  const double root = r * r / length2 - cross2(p, d) * cross2(p, d) / (length2 * length2);
  if (root <= 0) return sector(p, q);
  const double half = std::sqrt(root);
  const double enters = std::max(middle - half, 0.0), leaves = std::min(middle + half, 1.0);
  if (enters >= leaves) return sector(p, q);
  const glm::dvec2 in = p + enters * d, out = p + leaves * d;
  return sector(p, in) + 0.5 * cross2(in, out) + sector(out, q);
}

}  // namespace

std::vector<Facet> facets_of(const Mesh& mesh) {
  std::vector<Facet> facets;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    const glm::dvec3 n = glm::cross(b - a, c - a);
    facets.push_back({a, b, c, glm::normalize(n), 0.5 * glm::length(n)});
  }
  return facets;
}

double distance_to(const Facet& f, const glm::dvec3& origin, const glm::dvec3& direction) {
  const glm::dvec3 e1 = f.b - f.a, e2 = f.c - f.a, p = glm::cross(direction, e2);
  const double det = glm::dot(e1, p);
  if (det == 0) return -1;
  const glm::dvec3 s = origin - f.a, q = glm::cross(s, e1);
  const double u = glm::dot(s, p) / det, v = glm::dot(direction, q) / det;
  return u >= 0 && v >= 0 && u + v <= 1 ? glm::dot(e2, q) / det : -1;
}

FacetHit first_hit(const std::vector<Facet>& facets, const glm::dvec3& origin,
                   const glm::dvec3& direction) {
  FacetHit hit;
  double nearest = 0;
  for (const Facet& f : facets) {
    const double t = distance_to(f, origin, direction);
    if (t > 0 && (!hit.facet || t < nearest)) hit.facet = &f, nearest = t;
  }
  hit.at = origin + nearest * direction;
  return hit;
}

double area_in_ball(const Facet& f, const glm::dvec3& center, double radius) {
  const double height = glm::dot(center - f.a, f.normal);
  if (std::abs(height) >= radius) return 0;
  const double reach = radius + std::max(glm::length(f.b - f.a), glm::length(f.c - f.a));
  if (glm::dot(center - f.a, center - f.a) >= reach * reach) return 0;
  // In the facet's plane, from the middle of the circle that the ball cuts out of it.
  const glm::dvec3 x = glm::normalize(f.b - f.a), y = glm::cross(f.normal, x);
  const auto flat = [&](const glm::dvec3& p) {
    return glm::dvec2(glm::dot(p - center, x), glm::dot(p - center, y));
  };
  const std::array<glm::dvec2, 3> corners{flat(f.a), flat(f.b), flat(f.c)};
  const double r = std::sqrt(radius * radius - height * height);
  double area = 0;
  for (std::size_t i = 0; i < 3; ++i) area += wedge_in_disc(corners[i], corners[(i + 1) % 3], r);
  return std::max(area, 0.0);
}

}  // namespace pellucid::test

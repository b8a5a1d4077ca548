// Flat triangles in double: which a ray meets first, and how much of them lies in a ball.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace pellucid::test {

struct Facet {
  glm::dvec3 a, b, c;
  glm::dvec3 normal;  ///< unit, to the front side
  double area;
};

std::vector<Facet> facets_of(const Mesh& mesh);

/// Distance along the ray, or a negative number.
double distance_to(const Facet& facet, const glm::dvec3& origin, const glm::dvec3& direction);

/// The facet that the ray meets first and where, by trying them all; null without any.
struct FacetHit {
  const Facet* facet = nullptr;
  glm::dvec3 at{0.0};
};
FacetHit first_hit(const std::vector<Facet>& facets, const glm::dvec3& origin,
                   const glm::dvec3& direction);

/// Area of the part of the facet within `radius` of `center`, in closed form.
double area_in_ball(const Facet& facet, const glm::dvec3& center, double radius);

}  // namespace pellucid::test

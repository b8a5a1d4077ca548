// Every triangle and quadric against a ray in double, by formulas of their own (Moeller-Trumbore
// and the quadratic equation): the judge of BVH and intersectors.
#pragma once

#include <glm/glm.hpp>

#include "pack/pack.h"

namespace pellucid::stability {

struct BruteHit {
  double t = 0.0;  ///< 0 without a hit
  uint prim = NONE;
};

BruteHit brute_force_trace(const PackedScene& scene, const glm::dvec3& o, const glm::dvec3& d);

/// Distance along the ray to primitive `prim` if its outline, moved by `margin` (world units)
/// inwards (margin < 0) or outwards, is met; else a negative number.
double distance_to(const PackedScene& scene, uint prim, const glm::dvec3& o, const glm::dvec3& d,
                   double margin);

}  // namespace pellucid::stability

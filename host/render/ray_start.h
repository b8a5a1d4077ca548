// Where rays may start that leave a hit of a ray list: for the benchmark and for checks of hits.
#pragma once

#include <glm/vec3.hpp>

#include "render/ray_tracer.h"

namespace pellucid {

struct RayStart {
  glm::vec3 p, ng;    ///< the point and its unit geometric normal
  float offset;       ///< how far off p along ng rays start, on their own side
  float epsilon = 0;  ///< naive code: how far along the ray

  /// An endless ray along w, unit.
  TraceRay towards(const glm::vec3& w) const;
};

/// At a hit of a triangle (hit.prim != NONE), as kernels have it.
RayStart ray_start(const PackedScene& scene, const TraceHit& hit);
/// The same as naive code has it: at o + t d, an epsilon along the new ray.
RayStart naive_ray_start(const PackedScene& scene, const TraceRay& ray, const TraceHit& hit);

}  // namespace pellucid

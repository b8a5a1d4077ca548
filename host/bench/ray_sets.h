// Rays for the benchmark: camera rays, cosine bounces and shadow rays of one scene.
#pragma once

#include <vector>

#include "render/ray_tracer.h"

namespace pellucid {

enum class RayKind { primary, diffuse, shadow };
const char* ray_kind_name(RayKind kind);
/// Shadow rays only ask whether anything is hit.
inline bool wants_any_hit(RayKind kind) {
  return kind == RayKind::shadow;
}

/// One ray per pixel through its centre.
std::vector<TraceRay> primary_rays(const ::Camera& camera, int width, int height);

/// From each hit of `rays`, a cosine-distributed ray on the side it came from. Misses are left out.
std::vector<TraceRay> diffuse_rays(const PackedScene& scene, const std::vector<TraceRay>& rays,
                                   const std::vector<TraceHit>& hits);

/// From each hit of `rays`, a ray to a random point of a horizontal square of side `extent` around
/// `center` [3].
std::vector<TraceRay> shadow_rays(const PackedScene& scene, const std::vector<TraceRay>& rays,
                                  const std::vector<TraceHit>& hits, const float* center,
                                  double extent);

}  // namespace pellucid

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

struct RaySet {
  RayKind kind = RayKind::primary;
  std::vector<TraceRay> rays;
};

/// Of a room as tests make it, for a picture of that size: a ray per pixel through its centre; from
/// each of their hits a cosine-distributed ray on the side it came from, and a ray to a random
/// point of a square under the ceiling. `tracer` finds the hits and keeps the rays of the picture.
std::vector<RaySet> ray_sets(RayTracer& tracer, const PackedScene& scene, int width, int height);

}  // namespace pellucid

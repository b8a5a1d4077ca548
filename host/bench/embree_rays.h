// The same rays through Embree's single-ray interface, for comparison. Absent without libembree.
#pragma once

#include <memory>

#include "render/ray_tracer.h"

namespace pellucid {

class EmbreeRays {
 public:
  /// Whether this build has Embree; all else throws InternalError without it.
  static bool available();

  /// Builds over the triangles of `scene`, with as many threads as the machine has.
  EmbreeRays(const PackedScene& scene, bool robust);
  ~EmbreeRays();

  double build_seconds() const;
  void set_rays(const std::vector<TraceRay>& rays);
  /// Traces all rays by rtcIntersect1 or rtcOccluded1 on `threads` threads; returns wall seconds.
  double trace(bool any, int threads);
  std::vector<TraceHit> hits() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pellucid

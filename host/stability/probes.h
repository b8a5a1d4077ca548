// Device code by itself, over lists: frames around normals, and walks through a scene.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "render/plan.h"
#include "render/ray_tracer.h"
#include "stability/lab.h"

namespace pellucid::stability {

struct DeviceFrame {
  F4 s, t;
};

class FrameProbe {
 public:
  explicit FrameProbe(const Lab& lab);
  std::vector<DeviceFrame> frames(const std::vector<F4>& normals);

 private:
  Device device_;
  Kernel kernel_;
};

/// Where a walk ended: its last direction, and how often it was scattered.
struct WalkEnd {
  float dx, dy, dz;
  uint bounces;
};

class WalkProbe {
 public:
  WalkProbe(const Lab& lab, const Scene& scene);
  std::vector<WalkEnd> walk(const std::vector<TraceRay>& rays, uint bounces);

 private:
  Device device_;
  PackedScene packed_;
  Kernel kernel_;
};

}  // namespace pellucid::stability

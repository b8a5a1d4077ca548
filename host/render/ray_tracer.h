// Lists of rays through the very traversal that renders use: for the benchmark and for checks of
// hits.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cl/device.h"
#include "pack/pack.h"
#include "render/plan.h"

namespace pellucid {

struct TraceRay {
  float ox, oy, oz, t_max;   ///< origin; hits lie in (0, t_max]
  float dx, dy, dz, unused;  ///< unit direction
};
struct TraceHit {
  float t, b1, b2;
  uint prim;  ///< primitive id, or NONE
};

class RayTracer {
 public:
  /// Uploads the scene and builds both kernels, code generation included. Throws DeviceError.
  RayTracer(Device device, const PackedScene& scene, const PlanOptions& options);

  /// Goes on with another scene; kernels are built anew only if it needs others.
  void set_scene(const PackedScene& scene);

  /// Puts rays on the device for trace().
  void set_rays(const std::vector<TraceRay>& rays);

  /// Traces all rays; `any`: stops at the first hit found. Returns wall seconds of the finished
  /// queue.
  double trace(bool any);

  std::vector<TraceHit> hits();
  /// Counters of what went wrong since the last call.
  std::vector<Counter> take_counters();

 private:
  void bind(Kernel& kernel);

  Device device_;
  PlanOptions options_;
  SceneInfo info_{};
  ::Camera camera_{};
  std::string prelude_;  ///< of the kernels
  std::map<std::string, Buffer> buffers_;
  Kernel closest_, any_;
  uint count_ = 0;
};

}  // namespace pellucid

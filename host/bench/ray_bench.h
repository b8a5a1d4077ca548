// The ray benchmark: our traversal, and Embree's where present, interleaved run by run.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/figure.h"
#include "bench/ray_sets.h"

namespace pellucid {

struct RayCell {
  std::uint32_t triangles = 0;
  RayKind kind = RayKind::primary;
  Figure mrays_per_s;
  std::optional<Figure> embree_mrays_per_s, embree_robust_mrays_per_s;
  std::optional<Figure> ratio, ratio_robust;  ///< ours over Embree's, of runs next to each other
  std::uint64_t differing_hits = 0;           ///< rays whose hit or miss is not Embree's robust one
};

struct BuildCell {
  std::uint32_t triangles = 0;
  double seconds = 0;
  std::optional<double> embree_seconds;
};

struct RayBench {
  std::vector<RayCell> rays;
  std::vector<BuildCell> builds;
  std::string clock;  ///< what a run's time is: CPU or wall seconds
};

struct RayBenchOptions {
  int repeats = 7;
  int threads = 0;  ///< for Embree; 0: as many as the machine has
  PlanOptions plan;
  std::function<void(const std::string&)> progress;
};

/// Scenes must consist of triangles only.
RayBench bench_rays(const Device& device, const std::vector<Scene>& scenes,
                    const RayBenchOptions& options);

}  // namespace pellucid

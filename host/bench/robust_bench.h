// What robustness costs: the rays and renders of this program beside the same with naive
// intersection and spawned rays (render/naive_rays.h), run by run.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/figure.h"
#include "render/options.h"
#include "scene/scene.h"

namespace pellucid {

class Device;
struct Integrator;

struct PriceCell {
  std::string scene;
  std::uint32_t triangles = 0;
  std::string what;    ///< "primary", "diffuse" or "shadow" rays, or the method of a render
  Figure ours, naive;  ///< millions of rays per second
  MedianRange price;   ///< time over naive time, less 1, of runs next to each other
  std::optional<double> energy;            ///< of a render: the naive mean over ours, less 1
  std::optional<std::uint64_t> differing;  ///< rays whose hit or miss, or distance, is not ours
};

struct RobustBenchOptions {
  int repeats = 15;
  PlanOptions plan;
  std::function<void(const std::string&)> progress;
};

/// Lists of rays on `scenes`, and renders of them by `method`. They must consist of triangles only.
std::vector<PriceCell> bench_robustness(const Device& device, const std::vector<Scene>& scenes,
                                        const Integrator& method,
                                        const RobustBenchOptions& options);

}  // namespace pellucid

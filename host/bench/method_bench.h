// What each method is worth on each scene: error, time, and efficiency 1 / (relMSE x seconds)
// beside that of `path`.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "render/integrator.h"
#include "render/session.h"

namespace pellucid {

/// One method on one scene, at the samples per pixel that take about as long as those of the first
/// method.
struct MethodCell {
  std::string scene, method;
  std::uint64_t spp = 0;
  double relmse = 0;                       ///< mean of the repeats, against the reference
  double relmse_low = 0, relmse_high = 0;  ///< least and largest of the repeats
  double seconds = 0;                      ///< of a run, on all cores together
  double mrays_per_s = 0;
  double efficiency = 0;  ///< 1 / (relMSE x seconds)
  double gain = 0;        ///< efficiency over that of the first method
};

struct MethodBenchOptions {
  int repeats = 5;         ///< seeds
  int size = 64;           ///< pixels per side
  std::uint64_t spp = 64;  ///< of the first method
  std::uint64_t reference_spp = 4096;
  PlanOptions plan;
  std::function<void(const std::string&)> progress;
};

/// Runs of all methods take turns, seed by seed; the first of `methods` is what gains are over. The
/// reference of each scene is a long render by `referee`, of a seed of its own.
std::vector<MethodCell> bench_methods(const Device& device, std::vector<Scene> scenes,
                                      const std::vector<const Integrator*>& methods,
                                      const Integrator& referee, const MethodBenchOptions& options);

}  // namespace pellucid

// What each method is worth on each scene: error, time, and efficiency 1 / (relMSE x seconds)
// beside that of `path`.
#pragma once

#include <functional>
#include <optional>
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
  /// Share of the default radius that the referee merges within, where it does: its bias has to be
  /// small beside that of the methods.
  double reference_radius = 0.25;
  PlanOptions plan;
  std::function<void(const std::string&)> progress;
};

/// The method that a scene's reference is made by.
using Referee = std::function<const Integrator&(const PackedScene&, std::optional<unsigned> depth)>;

/// Runs of all methods take turns, seed by seed; the first of `methods` is what gains are over. The
/// reference of each scene is a long render by its referee, of a seed of its own.
std::vector<MethodCell> bench_methods(const Device& device, std::vector<Scene> scenes,
                                      const std::vector<const Integrator*>& methods,
                                      const Referee& referee, const MethodBenchOptions& options);

}  // namespace pellucid

// What each method does on each scene: speed, error, and efficiency 1 / (relMSE x seconds) beside
// that of the first method; and one score per method of all scenes.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/render_workload.h"
#include "render/integrator.h"
#include "render/session.h"

namespace pellucid {

/// One method on one scene, at the samples per pixel of workload_spp().
struct MethodCell {
  std::string scene, method;
  std::string failed;    ///< why there are no figures; else empty
  bool sees_all = true;  ///< no class of paths is out of the method's reach
  std::uint64_t spp = 0;
  /// By seed, against the reference and with its own error: the same on every run of the same
  /// program.
  std::vector<double> relmse_runs;
  double relmse = 0;           ///< their mean, less the reference's own
  double relmse_error = 0;     ///< one standard error of that mean; 0 of a single run
  double seconds = 0;          ///< of a run, on all cores together; mean
  double seconds_least = 0;    ///< of the fastest run: what others on the machine disturb least
  double paths = 0, rays = 0;  ///< of a run
  double kernel_seconds = 0;   ///< building kernels at first; the driver may have had them cached
  std::map<std::string, double> passes;  ///< seconds of a run by the device's clock, mean
  double efficiency = 0;                 ///< 1 / (relMSE x seconds)
  double gain = 0;                       ///< efficiency over that of the first method; 0: unknown
  /// Expected after as long as the first method's run, since errors fall as 1 / time (but for the
  /// bias of merging); 0: unknown.
  double relmse_equal_time = 0;
};

/// Geometric mean of SCORE_RELMSE x efficiency over the scenes on which the method sees all paths:
/// pictures with that error per second.
struct MethodScore {
  std::string method;
  std::vector<std::string> scenes;  ///< it is a mean of
  double score = 0;
  double low = 0, high = 0;   ///< two standard errors away, by the spread between seeds
  double samples_per_s = 0;   ///< geometric mean over the same scenes
  double kernel_seconds = 0;  ///< of all scenes together
};

/// What only those who know all methods can tell of a scene.
struct Judge {
  /// The method that the scene's reference is made by.
  std::function<const Integrator&(const PackedScene&, std::optional<unsigned> depth)> referee;
  std::function<bool(const Integrator&, const PackedScene&, std::optional<unsigned> depth)>
      sees_all;
};

struct MethodBenchOptions {
  int repeats = 5;  ///< seeds
  PlanOptions plan;
  std::function<void(const std::string&)> progress;
};

/// Runs of all methods take turns, seed by seed; the first of `methods` is what gains are over. The
/// reference of each scene is a long render by its referee, of a seed of its own. What the device
/// fails at is told in the cells.
std::vector<MethodCell> bench_methods(const Device& device, const std::vector<Scene>& scenes,
                                      const std::vector<const Integrator*>& methods,
                                      const Judge& judge, const MethodBenchOptions& options);

/// By method, in the order of the cells; none where a cell failed or errors are unknown.
std::vector<MethodScore> method_scores(const std::vector<MethodCell>& cells);

}  // namespace pellucid

// What the Sobol sampler is worth: error and time of `random` and `sobol` on the same scenes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "render/session.h"

namespace pellucid {

/// One scene at one number of samples per pixel; relMSE against a reference by random numbers, less
/// the reference's own, mean of the repeats.
struct SamplerCell {
  std::string scene;
  std::uint64_t spp = 0;
  double relmse_random = 0, relmse_sobol = 0;
  double ns_per_path_random = 0, ns_per_path_sobol = 0;  ///< of the scene, on all cores together

  double gain_equal_spp() const { return relmse_random / relmse_sobol; }
  /// Error falls as 1/spp or faster, so that the time of a path counts at least in full.
  double gain_equal_time() const {
    return gain_equal_spp() * ns_per_path_random / ns_per_path_sobol;
  }
};

struct SamplerBenchOptions {
  int repeats = 7;  ///< seeds
  int size = 32;    ///< pixels per side
  std::uint64_t reference_spp = 8192;
  std::vector<std::uint64_t> spp{16, 64, 256};
  PlanOptions plan;
  std::function<void(const std::string&)> progress;
};

/// Runs of both samplers take turns, seed by seed. Pixels are boxes: the filter's own spread of
/// values is not the sampler's doing.
std::vector<SamplerCell> bench_samplers(const Device& device, std::vector<Scene> scenes,
                                        const Integrator& method,
                                        const SamplerBenchOptions& options);

}  // namespace pellucid

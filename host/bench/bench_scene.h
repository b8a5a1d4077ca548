// A scene made ready to be rendered again and again, with error and time of every run.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/clock.h"
#include "render/session.h"

namespace pellucid {

struct BenchRun {
  std::vector<float> rgb;
  double relmse_estimate = 0;  ///< by the film itself
  double seconds = 0;          ///< of all cores together
  std::uint64_t rays = 0;
  double kernel_seconds = 0;             ///< until kernels were ready
  std::map<std::string, double> passes;  ///< seconds by the device's clock
};

class BenchScene {
 public:
  /// Square pictures of `size` pixels a side. Pixels are boxes: the filter's own spread of values
  /// is nobody's doing.
  BenchScene(const Device& device, Scene scene, int size, const PlanOptions& plan);

  /// Methods that merge do so within `radius_share` of the default radius.
  BenchRun render(const Integrator& method, Sampler sampler, std::uint64_t spp, std::uint64_t seed,
                  double radius_share = 1) const;
  const std::string& name() const { return scene_.name; }
  const PackedScene& packed() const { return packed_; }
  std::optional<unsigned> max_depth() const;

 private:
  Device device_;
  Scene scene_;
  PackedScene packed_;
  int size_;
  PlanOptions plan_;
  Clock clock_;
};

/// relMSE of a run against a reference (accuracy.md 2: e is 1 % of its mean), less the reference's
/// own.
double relmse_to(const BenchRun& reference, const BenchRun& run);

}  // namespace pellucid

// The photon grid: its passes, and these over a list of positions, for the benchmark and for checks
// of what is found.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cl/device.h"
#include "render/integrator.h"
#include "render/options.h"
#include "shared/layout.h"

namespace pellucid {

/// From stored light vertices to those sorted by cell.
std::vector<Pass> grid_passes();

/// A photon's place in the table of cells, and its own among all photons.
struct GridPair {
  uint bucket, place;
};

class PhotonGrid {
 public:
  /// Builds the kernels. Throws DeviceError.
  PhotonGrid(Device device, const PlanOptions& options);

  /// Puts photons on the device for build(), with a table of 2^grid_bits places for cells of twice
  /// `radius`, counted from `origin`.
  void set_photons(const std::vector<F4>& positions, float radius, const F4& origin,
                   uint grid_bits);

  const Launch& launch() const { return launch_; }

  /// Runs the passes. Returns wall seconds of the finished queue.
  double build();
  /// Seconds of each pass since the last call.
  std::map<std::string, double> take_times();

  /// Photons in order of the table, as build() leaves them.
  std::vector<GridPair> pairs();
  /// What merging would find around each point: the number of photons, the sums of their places,
  /// of the squares and of the cubes, modulo 2^32.
  std::vector<U4> find(const std::vector<F4>& points);

 private:
  struct Step {
    Pass pass;
    Kernel kernel;
    std::size_t group = 1;
    unsigned launch_index = 0;
    std::shared_ptr<PassTime> time = std::make_shared<PassTime>();
  };
  unsigned bind(Kernel& kernel, const std::vector<Bundle>& bundles);

  Device device_;
  std::vector<Step> steps_;
  Kernel probe_;
  std::size_t probe_group_;
  std::map<std::string, Buffer> buffers_;
  Launch launch_{};
};

}  // namespace pellucid

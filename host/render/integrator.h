// An integrator is a table: what it asks of kernels and which passes make an iteration.
#pragma once

#include <string>
#include <vector>

#include "pack/features.h"

namespace pellucid {

/// Bundles of kernels/shared/buffers.h, in the order of a kernel's parameters.
enum class Bundle { scene, filter, film, splat, aov, diag };

/// One kernel per iteration. `name` is the file passes/<name>.cl, its kernel, its timer and its row
/// in every report.
struct Pass {
  std::string name;
  std::vector<Bundle> bundles;  ///< parameters before the launch struct
};

struct Integrator {
  std::string name;
  std::string summary;       ///< one line for --help
  FeatureSet wishes;         ///< INTG_* flags
  bool weighs = false;       ///< combines strategies, so --mis has an effect
  std::vector<Pass> passes;  ///< in order; domain: pixels
};

}  // namespace pellucid

// Throughput that --max-depth cut off: an exact sum per kind of path, which passes, tiles, resumed
// and merged renders add to in any order.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "shared/buffers.h"

namespace pellucid {

/// Of one kind of paths, as shares of what each started with.
struct DepthCut {
  std::uint64_t whole = 0;  ///< the sum ...
  uint part = 0;            ///< ... and its steps of 2^-32 below 1
  std::uint64_t paths = 0;  ///< of this kind, cut or not; 0: nothing caps them

  void add(const DepthCut& other);
  /// What the cap kept an average path from carrying on; 0 without paths.
  double share() const;
};

/// By CUT_*.
using DepthCuts = std::array<DepthCut, CUT_COUNT>;

/// "camera" and "light", by CUT_*.
const std::array<const char*, CUT_COUNT>& cut_names();

void add_cuts(DepthCuts& into, const DepthCuts& other);

/// Adds what the device's words behind its counters (DIAG_CUTS) say.
void add_cut_words(DepthCuts& into, const std::vector<uint>& diag);

/// Counts the paths of `passes` passes over the launch's window, if it caps them.
void add_cut_paths(DepthCuts& into, const Launch& launch, bool walks_from_lights,
                   std::uint64_t passes);

/// "camera paths 0.1342, light paths 0.2" of their throughput in the mean, or "" without a cap.
std::string describe_cuts(const DepthCuts& cuts);

/// Whole sentence on what the cap cut off, or "" where that is nothing.
std::string cuts_verdict(const DepthCuts& cuts);

}  // namespace pellucid

// The photon grid's build beside sorts of the same pairs by the host, in turns.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bench/figure.h"
#include "cl/device.h"
#include "render/options.h"

namespace pellucid {

/// One number of photons: millions per second. The build takes their cells, sorts them, and brings
/// photons into that order; it has all cores. The host's sorts do nothing else, and have one.
struct SortCell {
  std::uint64_t photons = 0;
  Figure build, stable_sort, radix_sort;  ///< digits of 11 bits
  Figure ratio_stable, ratio_radix;       ///< build over host's sort, of runs next to each other
  std::vector<std::pair<std::string, double>> passes;  ///< seconds of a build
};

struct SortBenchOptions {
  int repeats = 7;
  std::vector<std::uint64_t> photons{100000, 300000, 1000000, 2000000};
  PlanOptions plan;
  std::function<void(const std::string&)> progress;
};

std::vector<SortCell> bench_sorts(const Device& device, const SortBenchOptions& options);

}  // namespace pellucid

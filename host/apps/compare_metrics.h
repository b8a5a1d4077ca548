// What `compare` finds, its metrics by name, and gates on them.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "image/metrics.h"
#include "image/replicates.h"
#include "image/ztest.h"

namespace pellucid {

struct Comparison {
  std::uint64_t nonfinite = 0;  ///< pixels with a NaN or Inf in any image
  ImageError error;
  double flip = std::numeric_limits<double>::quiet_NaN(), hdr_flip = flip;  ///< means
  std::size_t runs = 1;
  std::optional<RunSplit> split;  ///< where there are several runs
  std::optional<ZTest> ztest;     ///< where one was asked for
};

/// A metric by its name in gates, tables and JSON.
struct Metric {
  const char* name;
  double (*value)(const Comparison&);
  double ideal;  ///< gates bound the distance from it
  bool of_runs;  ///< there only with several runs
};
const std::vector<Metric>& compare_metrics();
/// "mse, rmse, ..."
std::string metric_names();

struct Gate {
  const Metric* metric;
  double limit;
  /// Written so that NaN never passes.
  bool holds(const Comparison& found) const;
};

/// From "metric=value". Throws UsageError.
Gate parse_gate(const std::string& text, bool several_runs);

}  // namespace pellucid

// The table of metrics: a new one is a line here.
#include "apps/compare_metrics.h"

#include <fmt/format.h>

#include <cmath>

#include "apps/common.h"
#include "base/error.h"
#include "base/text.h"

namespace pellucid {
namespace {

using Found = const Comparison&;

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const Metric& metric : compare_metrics()) all.push_back(metric.name);
  return all;
}

}  // namespace

const std::vector<Metric>& compare_metrics() {
  static const std::vector<Metric> all = {
      {"mse", [](Found f) { return f.error.mse; }, 0, false},
      {"rmse", [](Found f) { return f.error.rmse; }, 0, false},
      {"relmse", [](Found f) { return f.error.relmse; }, 0, false},
      {"trimmed_relmse", [](Found f) { return f.error.trimmed_relmse; }, 0, false},
      {"smape", [](Found f) { return f.error.smape; }, 0, false},
      {"flip", [](Found f) { return f.flip; }, 0, false},
      {"hdr_flip", [](Found f) { return f.hdr_flip; }, 0, false},
      {"p95_tile_relmse", [](Found f) { return f.error.p95_tile_relmse; }, 0, false},
      {"worst_tile_relmse", [](Found f) { return f.error.worst_tile_relmse; }, 0, false},
      {"tiles_within_1pct", [](Found f) { return f.error.tiles_within_1pct; }, 1, false},
      {"energy_ratio", [](Found f) { return f.error.energy_ratio; }, 1, false},
      {"worst_channel_energy", [](Found f) { return f.error.worst_channel_energy; }, 1, false},
      {"firefly_index", [](Found f) { return f.error.firefly_index; }, 0, false},
      {"variance", [](Found f) { return f.split->absolute.variance; }, 0, true},
      {"bias2", [](Found f) { return f.split->absolute.bias2; }, 0, true},
      {"bias2_upper90", [](Found f) { return f.split->absolute.bias2_upper90; }, 0, true},
      {"relvariance", [](Found f) { return f.split->relative.variance; }, 0, true},
      {"relbias2", [](Found f) { return f.split->relative.bias2; }, 0, true},
      {"relbias2_upper90", [](Found f) { return f.split->relative.bias2_upper90; }, 0, true},
  };
  return all;
}

std::string metric_names() {
  return join(names());
}

bool Gate::holds(const Comparison& found) const {
  return std::abs(metric->value(found) - metric->ideal) <= limit;
}

Gate parse_gate(const std::string& text, bool several_runs) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  for (const Metric& metric : compare_metrics()) {
    if (name != metric.name) continue;
    if (equals == std::string::npos)
      throw UsageError(fmt::format("--fail-above takes metric=value, such as {}=1e-3", name));
    if (metric.of_runs && !several_runs)
      throw UsageError(
          fmt::format("--fail-above {}: noise and bias are told apart by several runs; name the "
                      "others by --with",
                      name));
    const double limit = parse_fraction("--fail-above " + name, text.substr(equals + 1));
    if (limit < 0) throw UsageError(fmt::format("--fail-above {}: below 0 nothing passes", text));
    return {&metric, limit};
  }
  throw UsageError(fmt::format("--fail-above: there is no metric '{}', but {}.{}", name,
                               metric_names(), did_you_mean(name, names())));
}

}  // namespace pellucid

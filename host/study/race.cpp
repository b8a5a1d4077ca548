// Elimination after the pilot, and ladders by the cost of runs.
#include "study/race.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/statistics.h"
#include "base/text.h"
#include "study/analyse.h"
#include "study/ladder.h"

namespace pellucid {
namespace {

constexpr double least_spp = double(SOBOL_BLOCK << (LEAST_RUNGS - 1));

/// Wall seconds of all runs of an option to `spp`.
double cost_of(const Entry& entry, double spp) {
  const int runs = entry.option.state == OptionState::blind ? blind_runs : main_runs;
  return runs * entry.contender->cost(std::uint64_t(spp));
}

/// Leaves out options until the rest can have the rungs that a curve needs: first those that are
/// blind, then those worth least in the pilot.
void drop_too_slow(double seconds, std::vector<Entry>& entries) {
  const auto worth = [](const Entry* e) {
    return e->option.state == OptionState::blind ? -1.0 : e->option.pilot_efficiency;
  };
  for (;;) {
    const std::vector<Entry*> all = racing(entries);
    double sum = 0;
    for (const Entry* entry : all) sum += cost_of(*entry, least_spp);
    if (sum <= seconds || all.empty()) return;
    Entry* least = *std::min_element(all.begin(), all.end(),
                                     [&](Entry* a, Entry* b) { return worth(a) < worth(b); });
    if (least->option.state == OptionState::main) least->option.state = OptionState::too_slow;
    least->option.reason = fmt::format("{} rungs in {} runs would take {}", LEAST_RUNGS, main_runs,
                                       format_seconds(cost_of(*least, least_spp)));
    least->raced = false;
  }
}

}  // namespace

void eliminate(const Reference& reference, std::vector<Entry>& entries) {
  constexpr double dearer = 10, confidence = 0.99;
  const double t = student_quantile(confidence, 2 * (pilot_runs - 1));
  struct Cost {
    Entry* entry;
    double mean = 0, error = 0;  ///< of log (relMSE x seconds)
  };
  std::vector<Cost> costs;
  for (Entry& entry : entries) {
    if (!entry.asked || entry.option.state != OptionState::main) continue;
    Cost cost{&entry};
    std::vector<double> logs;
    for (const LadderStep& p : entry.pilots)
      logs.push_back(std::log(std::max(  // no error at all is a number, too
          weighted_distance(p.picture, reference.picture, reference.weights) * p.rung.seconds,
          std::numeric_limits<double>::min())));
    for (double v : logs) cost.mean += v / pilot_runs;
    for (double v : logs) cost.error += std::pow(v - cost.mean, 2);
    cost.error = std::sqrt(cost.error / (pilot_runs - 1) / pilot_runs);
    entry.option.pilot_efficiency = std::exp(-cost.mean);
    costs.push_back(cost);
  }
  if (costs.empty()) return;
  const Cost& best = *std::min_element(
      costs.begin(), costs.end(), [](const Cost& a, const Cost& b) { return a.mean < b.mean; });
  for (const Cost& cost : costs) {
    const double worse = cost.mean - best.mean - t * std::hypot(cost.error, best.error);
    if (worse < std::log(dearer)) continue;
    cost.entry->option.state = OptionState::pilot;
    constexpr double countable = 1e6;
    const double times = std::exp(std::min(cost.mean - best.mean, std::log(countable)));
    cost.entry->option.reason =
        fmt::format("{} {:.0f} times dearer than {}", times < countable ? "about" : "at least",
                    times, best.entry->contender->method().name);
  }
}

std::vector<Entry*> racing(std::vector<Entry>& entries) {
  std::vector<Entry*> out;
  for (Entry& entry : entries)
    if (entry.asked && entry.raced &&
        (entry.option.state == OptionState::main || entry.option.state == OptionState::blind))
      out.push_back(&entry);
  return out;
}

void plan_ladders(double seconds, std::vector<Entry>& entries) {
  drop_too_slow(seconds, entries);
  const std::vector<Entry*> all = racing(entries);
  double low = 0, high = seconds;  // of a run
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    double sum = 0;
    for (Entry* entry : all)
      sum +=
          cost_of(*entry, ladder_to(std::max(least_spp, entry->contender->spp_in(middle))).back());
    (sum <= seconds ? low : high) = middle;
  }
  for (Entry* entry : all) {
    entry->ladder = ladder_to(std::max(least_spp, entry->contender->spp_in(low)));
    entry->stacks.resize(entry->ladder.size());
  }
}

}  // namespace pellucid

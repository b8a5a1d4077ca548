// Methods in turns on one scene after the other, and their scores.
#include "bench/method_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "bench/bench_scene.h"
#include "shared/limits.h"

namespace pellucid {
namespace {

/// Seeds of the runs are 0, 1, ...
constexpr std::uint64_t reference_seed = 1000000, warm_up_seed = 2000000;

/// Runs `step`; what the device fails at ends this cell alone.
template <typename Step>
void attempt(MethodCell& cell, const Step& step) {
  if (!cell.failed.empty()) return;
  try {
    step();
  } catch (const DeviceError& e) {
    cell.failed = e.what();
  }
}

void add_run(MethodCell& cell, const BenchRun& reference, const BenchRun& run, int repeats) {
  const double error = relmse_to(reference, run);
  cell.relmse_runs.push_back(error + reference.relmse_estimate);
  cell.relmse += error / repeats;
  cell.seconds += run.seconds / repeats;
  cell.seconds_least = std::min(cell.seconds_least, run.seconds);
  cell.rays += double(run.rays) / repeats;
  for (const auto& [pass, seconds] : run.passes) cell.passes[pass] += seconds / repeats;
}

/// What follows from all runs; `first`: of the first method.
void conclude(MethodCell& cell, const MethodCell& first) {
  if (cell.failed.empty() && !(cell.relmse > 0))  // NaN as well
    cell.failed =
        fmt::format("its error, {:.2g}, cannot be told from the reference's", cell.relmse);
  if (!cell.failed.empty()) return;
  const double n = double(cell.relmse_runs.size());
  double mean = 0, square = 0;
  for (double e : cell.relmse_runs) mean += e / n;
  for (double e : cell.relmse_runs) square += (e - mean) * (e - mean);
  if (n > 1) cell.relmse_error = std::sqrt(square / (n - 1) / n);
  cell.efficiency = 1 / (cell.relmse * cell.seconds);
  if (!first.failed.empty()) return;
  cell.gain = cell.efficiency * first.relmse * first.seconds;
  cell.relmse_equal_time = first.relmse / cell.gain;
}

std::vector<MethodCell> bench_one(const BenchScene& scene,
                                  const std::vector<const Integrator*>& methods, const Judge& judge,
                                  const MethodBenchOptions& o) {
  const auto& packed = scene.packed();
  const auto depth = scene.max_depth();
  const auto say = [&](const std::string& what) {
    if (o.progress) o.progress(scene.name() + ": " + what);
  };
  std::vector<MethodCell> cells(methods.size());
  for (std::size_t m = 0; m < methods.size(); ++m) {
    MethodCell& cell = cells[m];
    cell.scene = scene.name();
    cell.method = methods[m]->name;
    cell.sees_all = judge.sees_all(*methods[m], packed, depth);
    cell.spp = workload_spp(cell.method);
    cell.seconds_least = std::numeric_limits<double>::infinity();
    cell.paths = double(cell.spp) * WORKLOAD_SIZE * WORKLOAD_SIZE;
    say("kernels of " + cell.method);
    attempt(cell, [&] {
      cell.kernel_seconds =
          scene.render(*methods[m], Sampler::sobol, SOBOL_BLOCK, warm_up_seed).kernel_seconds;
    });
  }
  say("reference");
  BenchRun reference;
  try {
    reference = scene.render(judge.referee(packed, depth), Sampler::random, WORKLOAD_REFERENCE_SPP,
                             reference_seed, WORKLOAD_REFERENCE_RADIUS);
  } catch (const DeviceError& e) {
    for (MethodCell& cell : cells)
      if (cell.failed.empty()) cell.failed = std::string("no reference: ") + e.what();
  }
  for (int k = 0; k < o.repeats; ++k)
    for (std::size_t turn = 0; turn < methods.size(); ++turn) {
      const std::size_t m = (turn + std::size_t(k)) % methods.size();  // nobody is always first
      say(fmt::format("seed {} of {}, {}", k + 1, o.repeats, cells[m].method));
      attempt(cells[m], [&] {
        add_run(cells[m], reference,
                scene.render(*methods[m], Sampler::sobol, cells[m].spp, std::uint64_t(k)),
                o.repeats);
      });
    }
  for (MethodCell& cell : cells) conclude(cell, cells.front());  // the first one first
  return cells;
}

/// A mean over fewer scenes than those of others would be another score.
bool failed_anywhere(const std::vector<MethodCell>& cells, const std::string& method) {
  return std::any_of(cells.begin(), cells.end(), [&](const MethodCell& cell) {
    return cell.method == method && !cell.failed.empty();
  });
}

}  // namespace

std::vector<MethodCell> bench_methods(const Device& device, const std::vector<Scene>& scenes,
                                      const std::vector<const Integrator*>& methods,
                                      const Judge& judge, const MethodBenchOptions& options) {
  std::vector<MethodCell> cells;
  for (const Scene& scene : scenes) {
    if (options.progress) options.progress(scene.name);
    const BenchScene ready(device, scene, WORKLOAD_SIZE, options.plan);
    for (const MethodCell& cell : bench_one(ready, methods, judge, options)) cells.push_back(cell);
  }
  return cells;
}

std::vector<MethodScore> method_scores(const std::vector<MethodCell>& cells) {
  struct Sums {
    double efficiency = 0, speed = 0, variance = 0;  // of logarithms
  };
  std::vector<MethodScore> scores;
  for (const MethodCell& any : cells) {
    const auto known = [&](const MethodScore& score) { return score.method == any.method; };
    if (std::any_of(scores.begin(), scores.end(), known)) continue;
    if (failed_anywhere(cells, any.method)) continue;
    MethodScore score;
    score.method = any.method;
    Sums sums;
    for (const MethodCell& cell : cells) {
      if (cell.method != any.method) continue;
      score.kernel_seconds += cell.kernel_seconds;
      if (!cell.sees_all) continue;
      score.scenes.push_back(cell.scene);
      sums.efficiency += std::log(SCORE_RELMSE * cell.efficiency);
      sums.speed += std::log(cell.paths / cell.seconds);
      const double relative = cell.relmse_error / cell.relmse;
      sums.variance += relative * relative;  // of a logarithm, to first order
    }
    if (score.scenes.empty()) continue;
    const double n = double(score.scenes.size());
    const double error = std::sqrt(sums.variance) / n;
    score.score = std::exp(sums.efficiency / n);
    score.low = score.score * std::exp(-2 * error);
    score.high = score.score * std::exp(2 * error);
    score.samples_per_s = std::exp(sums.speed / n);
    scores.push_back(score);
  }
  return scores;
}

}  // namespace pellucid

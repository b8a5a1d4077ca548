// Methods in turns on one scene after the other.
#include "bench/method_bench.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/bench_scene.h"
#include "shared/limits.h"

namespace pellucid {
namespace {

/// Samples per pixel for about the same time: whole blocks of the sampler.
std::uint64_t spp_for_time(double seconds_per_spp, double seconds) {
  const double blocks = seconds / seconds_per_spp / SOBOL_BLOCK;
  return SOBOL_BLOCK * std::max<std::uint64_t>(1, std::uint64_t(std::llround(blocks)));
}

std::vector<MethodCell> bench_one(const BenchScene& scene,
                                  const std::vector<const Integrator*>& methods,
                                  const Referee& referee, const MethodBenchOptions& o) {
  constexpr std::uint64_t reference_seed = 1000000, pilot_seed = 2000000;
  const BenchRun reference =
      scene.render(referee(scene.packed(), scene.max_depth()), Sampler::random, o.reference_spp,
                   reference_seed, o.reference_radius);
  std::vector<MethodCell> cells(methods.size());
  double seconds = 0;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const double pilot =
        scene.render(*methods[m], Sampler::sobol, SOBOL_BLOCK, pilot_seed).seconds / SOBOL_BLOCK;
    if (m == 0) seconds = pilot * double(o.spp);
    cells[m].scene = scene.name();
    cells[m].method = methods[m]->name;
    cells[m].spp = m == 0 ? o.spp : spp_for_time(pilot, seconds);
    cells[m].relmse_low = std::numeric_limits<double>::infinity();
  }
  for (int k = 0; k < o.repeats; ++k)
    for (std::size_t turn = 0; turn < methods.size(); ++turn) {
      const std::size_t m = (turn + std::size_t(k)) % methods.size();  // nobody is always first
      MethodCell& cell = cells[m];
      const BenchRun run = scene.render(*methods[m], Sampler::sobol, cell.spp, std::uint64_t(k));
      const double error = relmse_to(reference, run);
      cell.relmse += error / o.repeats;
      cell.relmse_low = std::min(cell.relmse_low, error);
      cell.relmse_high = std::max(cell.relmse_high, error);
      cell.seconds += run.seconds / o.repeats;
      cell.mrays_per_s += 1e-6 * double(run.rays) / run.seconds / o.repeats;
    }
  for (MethodCell& cell : cells) {
    cell.efficiency = 1 / (cell.relmse * cell.seconds);
    cell.gain = cell.efficiency / cells.front().efficiency;
  }
  return cells;
}

}  // namespace

std::vector<MethodCell> bench_methods(const Device& device, std::vector<Scene> scenes,
                                      const std::vector<const Integrator*>& methods,
                                      const Referee& referee, const MethodBenchOptions& options) {
  std::vector<MethodCell> cells;
  for (Scene& scene : scenes) {
    if (options.progress) options.progress(scene.name);
    const BenchScene ready(device, std::move(scene), options.size, options.plan);
    for (const MethodCell& cell : bench_one(ready, methods, referee, options))
      cells.push_back(cell);
  }
  return cells;
}

}  // namespace pellucid

// relMSE and time of two samplers, run by run in turns.
#include "bench/sampler_bench.h"

#include <array>

#include "bench/bench_scene.h"

namespace pellucid {
namespace {

constexpr std::array<Sampler, 2> samplers{Sampler::random, Sampler::sobol};

std::vector<SamplerCell> bench_one(const BenchScene& scene, const Integrator& method,
                                   const SamplerBenchOptions& o) {
  constexpr std::uint64_t reference_seed = 1000000;
  const BenchRun reference = scene.render(method, Sampler::random, o.reference_spp, reference_seed);
  std::vector<SamplerCell> cells;
  std::array<double, 2> seconds{}, paths{};
  for (std::uint64_t spp : o.spp) {
    std::array<double, 2> error{};
    for (int k = 0; k < o.repeats; ++k)
      for (std::size_t s = 0; s < samplers.size(); ++s) {
        const BenchRun run = scene.render(method, samplers[s], spp, std::uint64_t(k));
        error[s] += relmse_to(reference, run) / double(o.repeats);
        seconds[s] += run.seconds;
        paths[s] += double(spp) * o.size * o.size;
      }
    SamplerCell cell;
    cell.scene = scene.name();
    cell.spp = spp;
    cell.relmse_random = error[0], cell.relmse_sobol = error[1];
    cells.push_back(cell);
  }
  for (SamplerCell& cell : cells) {
    cell.ns_per_path_random = 1e9 * seconds[0] / paths[0];
    cell.ns_per_path_sobol = 1e9 * seconds[1] / paths[1];
  }
  return cells;
}

}  // namespace

std::vector<SamplerCell> bench_samplers(const Device& device, std::vector<Scene> scenes,
                                        const Integrator& method,
                                        const SamplerBenchOptions& options) {
  std::vector<SamplerCell> cells;
  for (Scene& scene : scenes) {
    if (options.progress) options.progress(scene.name);
    const BenchScene ready(device, std::move(scene), options.size, options.plan);
    for (const SamplerCell& cell : bench_one(ready, method, options)) cells.push_back(cell);
  }
  return cells;
}

}  // namespace pellucid

// relMSE and time of two samplers, run by run in turns.
#include "bench/sampler_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <thread>

#include "base/error.h"
#include "bench/clock.h"

namespace pellucid {
namespace {

constexpr std::array<Sampler, 2> samplers{Sampler::random, Sampler::sobol};

struct Run {
  std::vector<float> rgb;
  double relmse_estimate = 0;  ///< by the film itself
  double seconds = 0;
};

/// One scene ready to be rendered again and again.
struct Subject {
  const Device& device;
  const Integrator& method;
  const SamplerBenchOptions& options;
  Clock clock;
  const Scene& scene;
  PackedScene packed;

  Run render(Sampler sampler, std::uint64_t spp, std::uint64_t seed) const;
};

Run Subject::render(Sampler sampler, std::uint64_t spp, std::uint64_t seed) const {
  RenderOptions o;
  o.width = o.height = options.size;
  o.passes = PassRange{0, spp};
  o.seed = seed;
  if (scene.settings.max_depth) o.max_depth = uint(*scene.settings.max_depth);
  o.plan = options.plan;
  o.plan.sampler = sampler;
  Session session(device, packed, method, o);
  Run run;
  run.seconds = clock([&] {
    session.run({});
    return session.render_seconds();
  });
  run.rgb = film_image(session.film(), false, false).data;
  run.relmse_estimate = summarise(session.film()).relmse;
  return run;
}

/// accuracy.md 2: e is 1 % of the reference's mean.
double relmse(const std::vector<float>& image, const std::vector<float>& reference) {
  const double n = double(reference.size());
  double mean = 0, sum = 0;
  for (float v : reference) mean += v / n;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const double d = double(image[i]) - reference[i];
    sum += d * d / (double(reference[i]) * reference[i] + 1e-4 * mean * mean) / n;
  }
  return sum;
}

std::vector<SamplerCell> bench_scene(const Subject& subject) {
  const SamplerBenchOptions& o = subject.options;
  constexpr std::uint64_t reference_seed = 1000000;
  const Run reference = subject.render(Sampler::random, o.reference_spp, reference_seed);
  std::vector<SamplerCell> cells;
  std::array<double, 2> seconds{}, paths{};
  for (std::uint64_t spp : o.spp) {
    std::array<double, 2> error{};
    for (int k = 0; k < o.repeats; ++k)
      for (std::size_t s = 0; s < samplers.size(); ++s) {
        const Run run = subject.render(samplers[s], spp, std::uint64_t(k));
        error[s] +=
            (relmse(run.rgb, reference.rgb) - reference.relmse_estimate) / double(o.repeats);
        seconds[s] += run.seconds;
        paths[s] += double(spp) * o.size * o.size;
      }
    SamplerCell cell;
    cell.scene = subject.scene.name;
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
  const int cores = int(std::max(1u, std::thread::hardware_concurrency()));
  std::vector<SamplerCell> cells;
  for (Scene& scene : scenes) {
    if (options.progress) options.progress(scene.name);
    scene.settings.width = scene.settings.height = options.size;
    scene.settings.filter = PixelFilter::box;
    const Subject subject{device,  method,
                          options, Clock{device.info().cpu, cores},
                          scene,   pack_scene(scene, {simd_width_for(device.info())})};
    for (const SamplerCell& cell : bench_scene(subject)) cells.push_back(cell);
  }
  return cells;
}

}  // namespace pellucid

// Runs on one scene, and their error.
#include "bench/bench_scene.h"

#include "base/relmse.h"
#include "render/launch.h"
#include "render/naive_rays.h"

namespace pellucid {

BenchScene::BenchScene(const Device& device, Scene scene, int size, const PlanOptions& plan)
    : device_(device),
      scene_(std::move(scene)),
      size_(size),
      plan_(plan),
      clock_{device.info().cpu, device_cores(device.info())} {
  scene_.settings.width = scene_.settings.height = size;
  scene_.settings.filter = PixelFilter::box;
  packed_ = pack_scene(scene_, {simd_width_for(device.info())});
  if (plan_.overlay == NAIVE_OVERLAY) packed_ = for_naive_rays(std::move(packed_));
}

std::optional<unsigned> BenchScene::max_depth() const {
  if (!scene_.settings.max_depth) return std::nullopt;
  return unsigned(*scene_.settings.max_depth);
}

BenchRun BenchScene::render(const Integrator& method, Sampler sampler, std::uint64_t spp,
                            std::uint64_t seed, double radius_share) const {
  RenderOptions o;
  o.width = o.height = size_;
  o.passes = PassRange{0, spp};
  o.seed = seed;
  o.max_depth = max_depth();
  if (radius_share != 1) o.radius = radius_share * default_radius(packed_, o.light_path_count());
  o.plan = plan_;
  o.plan.sampler = sampler;
  Session session(device_, packed_, method, o);
  BenchRun run;
  run.seconds = clock_([&] {
    session.run({});
    return session.render_seconds();
  });
  const FilmSummary summary = summarise(session.film());
  run.rgb = film_image(session.film(), false, false).data;
  run.relmse_estimate = summary.relmse;
  run.rays = summary.rays;
  run.kernel_seconds = session.kernel_seconds();
  for (const PassState& p : session.plan().passes()) run.passes[p.pass.name] += p.time->seconds;
  return run;
}

double relmse_to(const BenchRun& reference, const BenchRun& run) {
  const double n = double(reference.rgb.size());
  double mean = 0, sum = 0;
  for (float v : reference.rgb) mean += v / n;
  for (std::size_t i = 0; i < reference.rgb.size(); ++i) {
    const double expected = reference.rgb[i], d = double(run.rgb[i]) - expected;
    sum += d * d * relmse_weight(expected, RELMSE_EPSILON * mean) / n;
  }
  return sum - reference.relmse_estimate;
}

}  // namespace pellucid

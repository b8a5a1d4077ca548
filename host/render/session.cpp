// The render loop: batches of iterations, each short enough to stay responsive.
#include "render/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "base/timer.h"

namespace pellucid {
namespace {

/// Mixes a 64-bit user seed into the word that kernels get (SplitMix64's finaliser), so that seeds
/// 0, 1, 2 share nothing.
uint hash_seed(std::uint64_t seed) {
  seed += 0x9e3779b97f4a7c15ull;
  seed = (seed ^ (seed >> 30)) * 0xbf58476d1ce4e5b9ull;
  seed = (seed ^ (seed >> 27)) * 0x94d049bb133111ebull;
  return static_cast<uint>((seed ^ (seed >> 31)) >> 32);
}

/// Time between two looks at signals and the clock.
constexpr double batch_seconds = 0.2;

Plan timed_plan(const Device& device, const PackedScene& scene, const Integrator& integrator,
                const RenderOptions& options, double& seconds) {
  const Timer timer;
  const std::size_t pixels = std::size_t(options.width) * std::size_t(options.height);
  check_memory(device.info(), plan_memory(scene, integrator, pixels));
  Plan plan(device, scene, integrator, options.plan, uint(options.width), uint(options.height));
  seconds = timer.seconds();
  return plan;
}

}  // namespace

void check_memory(const DeviceInfo& device, const std::map<std::string, std::size_t>& buffers) {
  std::uint64_t total = 0;
  for (const auto& [name, bytes] : buffers) {
    total += bytes;
    if (bytes > device.max_buffer)
      throw DeviceError(fmt::format("buffer '{}' needs {}, but one buffer on {} holds at most {}",
                                    name, format_bytes(bytes), device.name,
                                    format_bytes(device.max_buffer)));
  }
  if (total > device.memory)
    throw DeviceError(fmt::format("this render needs {} of device memory, but {} has {}",
                                  format_bytes(total), device.name, format_bytes(device.memory)));
}

Session::Session(const Device& device, const PackedScene& scene, const Integrator& integrator,
                 const RenderOptions& options)
    : options_(options), plan_(timed_plan(device, scene, integrator, options, kernel_seconds_)) {
  PELLUCID_CHECK(options_.spp || options_.seconds, "a render needs a budget");
  launch_.width = launch_.tile_width = uint(options_.width);
  launch_.height = launch_.tile_height = uint(options_.height);
  launch_.seed = hash_seed(options_.seed);
  launch_.max_depth = options_.max_depth.value_or(NONE);
  launch_.mis = options_.mis;
  launch_.splat_scale = 1048576.0f;  // no method here splats yet; light tracing sets it by power
}

std::uint64_t Session::batch_size(double seconds_per_iteration) const {
  std::uint64_t batch = 1;
  if (seconds_per_iteration > 0)
    batch = std::uint64_t(std::clamp(batch_seconds / seconds_per_iteration, 1.0, 4096.0));
  if (options_.spp) batch = std::min(batch, *options_.spp - iteration_);
  return batch;
}

std::string Session::progress_text(double elapsed) {
  if (elapsed >= next_look_) {
    const Timer cost;
    seen_ = summarise(plan_.read_film());
    // Rays and noise need the whole film: seldom enough to stay below 2 % of the time.
    constexpr double least_pause = 1.0, times_its_cost = 50.0;
    next_look_ = elapsed + std::max(least_pause, times_its_cost * cost.seconds());
  }
  const double done_spp = options_.spp ? double(iteration_) / double(*options_.spp) : 0.0;
  const double done_time = options_.seconds ? elapsed / *options_.seconds : 0.0;
  const double done = std::min(1.0, std::max(done_spp, done_time));
  const double left = done > 0 ? elapsed / done - elapsed : 0.0;
  const double rays_per_iteration =
      double(seen_.rays) / double(std::max<std::uint64_t>(seen_.iterations, 1));
  return fmt::format("{:3.0f} %  pass {}  {:.1f} Mrays/s  {} left{}", 100 * done, iteration_,
                     1e-6 * rays_per_iteration * double(iteration_) / elapsed, format_seconds(left),
                     std::isfinite(seen_.relmse)
                         ? fmt::format("  noise {:.2g} %", 100 * std::sqrt(seen_.relmse))
                         : "");
}

bool Session::run(const RenderHooks& hooks) {
  const Timer timer;
  const double seconds_before = render_seconds_;
  bool stopped = false;
  while (!stopped) {
    const double elapsed = timer.seconds();
    if (options_.spp && iteration_ >= *options_.spp) break;
    if (options_.seconds && iteration_ > 0 && elapsed >= *options_.seconds) break;
    const std::uint64_t batch = batch_size(iteration_ ? elapsed / double(iteration_) : 0.0);
    for (std::uint64_t i = 0; i < batch; ++i) {
      launch_.iteration = static_cast<uint>(iteration_++);
      plan_.enqueue(launch_);
    }
    plan_.finish();
    if (hooks.progress) hooks.progress(progress_text(timer.seconds()));
    render_seconds_ = seconds_before + timer.seconds();
    if (hooks.wants_image && hooks.wants_image()) {
      plan_.collect(counters_);
      hooks.image(plan_.read_film());
    }
    stopped = hooks.stop && hooks.stop();
  }
  render_seconds_ = seconds_before + timer.seconds();
  plan_.collect(counters_);
  return !stopped || (options_.spp && iteration_ >= *options_.spp);
}

}  // namespace pellucid

// The render loop: batches of iterations, each short enough to stay responsive.
#include "render/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "base/timer.h"
#include "render/launch.h"
#include "shared/limits.h"

namespace pellucid {
namespace {

/// Time between two looks at signals and the clock.
constexpr double batch_seconds = 0.2;
/// A batch lasts at least so many times what moving its tiles costs.
constexpr double least_work_per_swap = 20.0;

Plan timed_plan(const Device& device, const PackedScene& scene, const Integrator& integrator,
                const RenderOptions& options, const MemoryPlan& memory, double& seconds) {
  const Timer timer;
  Plan plan(device, scene, integrator, options, memory);
  seconds = timer.seconds();
  return plan;
}

std::uint64_t block_size_of(const Plan& plan) {
  return plan.specialisation().features.has(INTG_SOBOL) ? SOBOL_BLOCK : 1u;
}

}  // namespace

Session::Session(const Device& device, const PackedScene& scene, const Integrator& integrator,
                 const RenderOptions& options, std::optional<Film> start)
    : options_(options),
      memory_(plan_memory(device.info(), scene, integrator, options)),
      plan_(timed_plan(device, scene, integrator, options, memory_, kernel_seconds_)),
      film_(options.width, options.height, options.window(),
            scene.brightness_exponent - FILM_FRACTION_BITS, block_size_of(plan_)),
      light_walks_(integrator.walks_from_lights()) {
  PELLUCID_CHECK(options_.passes || options_.seconds || options_.error, "a render needs a budget");
  launch_ = make_launch(scene, options_.width, options_.height, options_.window(),
                        options_.light_paths.value_or(0));
  launch_.seed = hash_seed(options_.seed);
  launch_.max_depth = options_.max_depth.value_or(NONE);
  launch_.mis = options_.mis;
  launch_.layer_set = integrator.layers;
  launch_.record_capacity = uint(options_.record_events);
  launch_.record_path = options_.record_path;
  film_.layers = Layers(integrator.layers, launch_.layer_scale, film_.pixels.size());
  device_has_film_ = !start && memory_.tiles.size() == 1;  // both black
  if (start) {
    PELLUCID_CHECK(start->window == film_.window && start->lsb == film_.lsb &&
                       start->block_size == film_.block_size &&
                       start->layers.set == film_.layers.set &&
                       start->layers.scale == film_.layers.scale,
                   "a film to go on with is of the same picture");
    film_ = std::move(*start);
  }
  if (options_.error) error_.emplace(*options_.error, film_, options_.least_effective);
  if (options_.error && options_.known_error) error_->recall(*options_.known_error);
}

/// The next passes to do, at most `most` and within one block unless every block on the way is new
/// and gets complete.
std::optional<Session::Batch> Session::next_batch(std::uint64_t most) const {
  const PassRange wanted = options_.passes.value_or(PassRange{0, std::uint64_t{1} << 32});
  const std::vector<PassRange> gaps = film_.passes.missing(wanted);
  if (gaps.empty()) return std::nullopt;
  const PassRange gap = gaps.front();
  const PassRange block = film_.block_range(gap.first / film_.block_size);
  const bool fresh = film_.passes.count(block) == 0 && gap.first == block.first;
  std::uint64_t count = std::min(most, gap.count());
  if (error_) count = std::min(count, error_->border() - film_.passes.count());
  if (!fresh) count = std::min(count, block.last - gap.first);
  // Whole blocks, or a part of one: a batch never ends in its second block.
  if (count > film_.block_size) count -= count % film_.block_size;
  return Batch{gap.first, count};
}

void Session::to_device(const Window& tile) {
  if (device_has_film_) return;
  const std::size_t first = std::size_t(tile.y0 - film_.window.y0) * std::size_t(tile.width);
  plan_.write_film(film_.pixels.data() + first, tile.pixels());
  plan_.write_layers(film_.layers, first, tile.pixels());
}

void Session::to_host(const Window& tile) {
  const std::size_t first = std::size_t(tile.y0 - film_.window.y0) * std::size_t(tile.width);
  plan_.read_film(film_.pixels.data() + first, tile.pixels());
  plan_.read_layers(film_.layers, first, tile.pixels());
}

const Film& Session::film() {
  if (!host_has_film_) to_host(memory_.tiles.front());
  host_has_film_ = true;
  return film_;
}

void Session::render_batch(const Batch& batch) {
  const std::uint64_t block = batch.first / film_.block_size;
  if (film_.current != block && (film_.current || film_.open.count(block))) {
    film();
    device_has_film_ = false;
  }
  film_.select_block(block);
  const bool one_tile = memory_.tiles.size() == 1;
  double swapping = 0;
  for (const Window& tile : memory_.tiles) {
    set_tile(launch_, tile);
    Timer swap;
    to_device(tile);
    swapping += swap.seconds();
    for (std::uint64_t i = 0; i < batch.count; ++i) {
      const std::uint64_t pass = batch.first + i;
      const PassRange its = film_.block_range(pass / film_.block_size);
      // Passes of the block that are done when this one is: those before the batch and our own.
      const std::uint64_t ours = pass + 1 - std::max(its.first, batch.first);
      launch_.block_ends = film_.passes.count(its) + ours == its.count();
      launch_.iteration = static_cast<uint>(pass);
      plan_.enqueue(launch_);
    }
    plan_.finish();
    plan_.collect(counters_, cuts_);
    swap = Timer();
    if (!one_tile) to_host(tile);
    swapping += swap.seconds();
  }
  swap_seconds_ = one_tile ? 0 : swapping;
  device_has_film_ = one_tile;
  host_has_film_ = !one_tile;
  film_.passes.add({batch.first, batch.first + batch.count});
  add_cut_paths(cuts_, launch_, light_walks_, batch.count);
  const std::uint64_t last = (batch.first + batch.count - 1) / film_.block_size;
  film_.current.reset();
  if (!film_.passes.contains(film_.block_range(last))) film_.current = last;
}

std::uint64_t Session::batch_limit(double elapsed, std::uint64_t done) const {
  constexpr double most = 4096.0;
  const double target = std::max(batch_seconds, least_work_per_swap * swap_seconds_);
  return done ? std::uint64_t(std::clamp(target / (elapsed / double(done)), 1.0, most)) : 1;
}

/// Of what ends the render first, as far as that is known.
double Session::part_done(double elapsed, std::uint64_t done) const {
  const PassRange wanted = options_.passes.value_or(PassRange{0, 0});
  std::uint64_t left = 0;
  for (const PassRange& gap : film_.passes.missing(wanted)) left += gap.count();
  double part = 0;
  if (options_.passes) part = double(done) / double(std::max<std::uint64_t>(done + left, 1));
  if (options_.seconds) part = std::max(part, elapsed / *options_.seconds);
  const std::uint64_t end = error_ ? error_->likely_end(seen_) : 0;
  if (end > film_.passes.count())
    part = std::max(part, double(done) / double(done + end - film_.passes.count()));
  return std::min(1.0, part);
}

std::string Session::progress_text(double elapsed, std::uint64_t done) {
  if (elapsed >= next_look_) {
    const Timer cost;
    seen_ = summarise(film());
    // Rays and noise need the whole film: seldom enough to stay below 2 % of the time.
    constexpr double least_pause = 1.0, times_its_cost = 50.0;
    next_look_ = elapsed + std::max(least_pause, times_its_cost * cost.seconds());
  }
  const double part = part_done(elapsed, done);
  const double seconds_left = part > 0 ? elapsed / part - elapsed : 0.0;
  const double rays_per_pass =
      double(seen_.rays) / double(std::max<std::uint64_t>(seen_.iterations, 1));
  return fmt::format(
      "{:3.0f} %  pass {}  {:.1f} Mrays/s  {} left{}{}", 100 * part, film_.passes.count(),
      1e-6 * rays_per_pass * double(done) / elapsed, format_seconds(seconds_left),
      std::isfinite(seen_.relmse) ? fmt::format("  noise {:.2g} %", 100 * std::sqrt(seen_.relmse))
                                  : "",
      error_ ? fmt::format("  wanted {:.2g} %", 100 * error_->target()) : "");
}

bool Session::run(const RenderHooks& hooks) {
  const Timer timer;
  const double seconds_before = render_seconds_;
  std::uint64_t done = 0;
  bool complete = true;
  while (true) {
    const double elapsed = timer.seconds();
    if (options_.seconds && done > 0 && elapsed >= *options_.seconds) break;
    if (error_ && error_->reached()) break;
    const std::optional<Batch> batch = next_batch(batch_limit(elapsed, done));
    if (!batch) break;
    if (done > 0 && hooks.stop && hooks.stop()) {
      complete = false;
      break;
    }
    render_batch(*batch);
    done += batch->count;
    if (error_ && film_.passes.count() == error_->border()) error_->observe(film());
    if (hooks.progress) hooks.progress(progress_text(timer.seconds(), done));
    render_seconds_ = seconds_before + timer.seconds();
    if (hooks.wants_film && hooks.wants_film()) hooks.film(film());
  }
  if (error_) error_->finish(film());
  render_seconds_ = seconds_before + timer.seconds();
  return complete;
}

void Session::add_counters(const std::vector<Counter>& earlier, const DepthCuts& cuts) {
  for (std::size_t i = 0; i < counters_.size(); ++i) counters_[i].count += earlier.at(i).count;
  add_cuts(cuts_, cuts);
}

}  // namespace pellucid

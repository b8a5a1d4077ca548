// A render from first to last iteration: budget, progress, stopping, results.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "render/error_estimate.h"
#include "render/film.h"
#include "render/memory.h"
#include "render/plan.h"

namespace pellucid {

/// Polled between batches of iterations.
struct RenderHooks {
  std::function<bool()> stop;  ///< true: end after the pass in hand
  std::function<void(const std::string&)> progress;
  std::function<bool()> wants_film;       ///< true: hand out the film so far ...
  std::function<void(const Film&)> film;  ///< ... to this
};

class Session {
 public:
  /// Makes everything ready; `start` is a film to go on with, of the same picture and block size.
  /// Throws DeviceError.
  Session(const Device& device, const PackedScene& scene, const Integrator& integrator,
          const RenderOptions& options, std::optional<Film> start = {});

  /// Renders until the budget is used up or a hook says stop (then returns false).
  bool run(const RenderHooks& hooks);

  /// What run() is to have done in the end, from now on.
  void set_passes(const PassRange& passes) { options_.passes = passes; }

  /// With all passes done so far.
  const Film& film();
  double render_seconds() const { return render_seconds_; }  ///< of run()
  double kernel_seconds() const { return kernel_seconds_; }
  const std::vector<Counter>& counters() const { return counters_; }
  /// What --max-depth cut off.
  const DepthCuts& cuts() const { return cuts_; }
  /// Puts what earlier passes counted in front of ours.
  void add_counters(const std::vector<Counter>& earlier, const DepthCuts& cuts);
  const Plan& plan() const { return plan_; }
  Plan& plan() { return plan_; }
  const MemoryPlan& memory() const { return memory_; }
  /// What is known of the error, where one is asked for.
  const std::optional<ErrorEstimate>& error() const { return error_; }

 private:
  struct Batch {
    std::uint64_t first = 0, count = 0;
  };
  std::optional<Batch> next_batch(std::uint64_t most) const;
  std::uint64_t batch_limit(double elapsed, std::uint64_t done) const;
  void render_batch(const Batch& batch);
  void to_device(const Window& tile);
  void to_host(const Window& tile);
  std::string progress_text(double elapsed, std::uint64_t done);
  double part_done(double elapsed, std::uint64_t done) const;

  RenderOptions options_;
  MemoryPlan memory_;
  double kernel_seconds_ = 0;
  Plan plan_;
  Launch launch_{};
  Film film_;
  bool light_walks_;
  bool device_has_film_, host_has_film_ = true;  ///< which of them know all passes done
  double swap_seconds_ = 0;                      ///< of moving all tiles once
  std::optional<ErrorEstimate> error_;
  FilmSummary seen_;      ///< of the last look at the film, for the progress line
  double next_look_ = 0;  ///< seconds after the start of run()
  double render_seconds_ = 0;
  std::vector<Counter> counters_ = make_counters();
  DepthCuts cuts_{};
};

}  // namespace pellucid

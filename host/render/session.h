// A render from first to last iteration: budget, progress, stopping, results.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "render/film.h"
#include "render/plan.h"

namespace pellucid {

struct RenderOptions {
  int width = 512, height = 512;     ///< must agree with the packed camera
  std::optional<std::uint64_t> spp;  ///< iterations
  std::optional<double> seconds;     ///< ends the render after the iteration in hand
  std::uint64_t seed = 0;
  std::optional<uint> max_depth;  ///< segments; absent = unlimited
  uint mis = MIS_BALANCE;
  PlanOptions plan;
};

/// Polled between batches of iterations.
struct RenderHooks {
  std::function<bool()> stop;  ///< true: end after the pass in hand
  std::function<void(const std::string&)> progress;
  std::function<bool()> wants_image;  ///< true: hand out the image so far ...
  std::function<void(const std::vector<FilmPixel>&)> image;  ///< ... to this
};

/// Throws DeviceError with the figures if `device` has too little memory for these buffers; asking
/// before anything is allocated saves the time until an allocation fails.
void check_memory(const DeviceInfo& device, const std::map<std::string, std::size_t>& buffers);

class Session {
 public:
  Session(const Device& device, const PackedScene& scene, const Integrator& integrator,
          const RenderOptions& options);

  /// Renders until the budget is used up or a hook says stop (then returns false).
  bool run(const RenderHooks& hooks);

  std::vector<FilmPixel> film() { return plan_.read_film(); }
  std::uint64_t iterations() const { return iteration_; }
  double render_seconds() const { return render_seconds_; }
  double kernel_seconds() const { return kernel_seconds_; }
  const std::vector<Counter>& counters() const { return counters_; }
  const Plan& plan() const { return plan_; }

 private:
  std::uint64_t batch_size(double seconds_per_iteration) const;
  std::string progress_text(double elapsed);

  RenderOptions options_;
  double kernel_seconds_ = 0;
  Plan plan_;
  Launch launch_{};
  FilmSummary seen_;      ///< of the last look at the film, for the progress line
  double next_look_ = 0;  ///< seconds after the start of run()
  std::uint64_t iteration_ = 0;
  double render_seconds_ = 0;
  std::vector<Counter> counters_ = make_counters();
};

}  // namespace pellucid

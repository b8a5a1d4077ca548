// Where the wall time of a process goes. It is in exactly one phase at any time, so that phases add
// up to all of it, whatever is forgotten.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <thread>

namespace pellucid {

/// Name and meaning, as in `render --stats`.
#define PHASES(X)                                                                      \
  X(start, "the process started, the command line read")                               \
  X(load, "scene, models and textures read and checked")                               \
  X(device, "driver and image library loaded, the device opened")                      \
  X(bvh, "scene packed, BVH built")                                                    \
  X(kernels, "kernels built, for AOVs, too")                                           \
  X(film, "film and other buffers allocated, moved from and to the device, summed up") \
  X(aov, "AOVs rendered")                                                              \
  X(render, "passes, and what it takes to run them")                                   \
  X(checkpoint, "checkpoints read and written")                                        \
  X(write, "pictures made and written")

enum class Phase : std::size_t {
#define X(name, meaning) name,
  PHASES(X)
#undef X
};

#define X(name, meaning) +1
constexpr std::size_t PHASE_COUNT = PHASES(X);
#undef X

class PhaseClock {
 public:
  /// `already`: seconds spent in `first` before the clock was there.
  explicit PhaseClock(Phase first, double already = 0);

  Phase now() const { return now_; }
  /// Of another thread than the one that made the clock: without effect.
  void enter(Phase phase);
  double seconds(Phase phase) const;  ///< until now
  double total() const;

 private:
  using Time = std::chrono::steady_clock;
  double running() const { return std::chrono::duration<double>(Time::now() - since_).count(); }

  std::thread::id owner_ = std::this_thread::get_id();
  std::array<double, PHASE_COUNT> seconds_{};
  Phase now_;
  Time::time_point since_ = Time::now();
};

/// Of this process, from its start on.
PhaseClock& process_clock();

/// The process is in a phase until the scope ends, then in the former one again.
class PhaseScope {
 public:
  explicit PhaseScope(Phase phase, PhaseClock& clock = process_clock())
      : clock_(clock), before_(clock.now()) {
    clock_.enter(phase);
  }
  ~PhaseScope() { clock_.enter(before_); }
  PhaseScope(const PhaseScope&) = delete;
  PhaseScope& operator=(const PhaseScope&) = delete;

 private:
  PhaseClock& clock_;
  Phase before_;
};

}  // namespace pellucid

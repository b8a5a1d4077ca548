// A method in one precision, ready to be run again and again on a study's scene.
#pragma once

#include <functional>
#include <limits>
#include <string>

#include "pack/pack.h"
#include "render/session.h"
#include "study/picture_stack.h"

namespace pellucid {

/// What all runs of a study share.
struct StudyStage {
  Device device;
  const PackedScene& packed;
  RenderOptions options;  ///< size, crop, depth, memory
  std::function<bool()> stop;
};

/// Thrown when the user wants the study to end: what was measured before stays.
struct StudyStopped {};

struct LadderStep {
  Rung rung;  ///< without errors
  Picture picture;
};

class Contender {
 public:
  Contender(const StudyStage& stage, const Integrator& method, const std::string& precision);
  /// This one, what it knows of its costs included, with another radius of merging.
  Contender with_radius(double factor) const;

  /// Renders through the ladder of samples per pixel and hands out the picture at each rung; the
  /// clock stands still meanwhile. Throws StudyStopped.
  void run(std::uint64_t seed, const std::vector<std::uint64_t>& ladder,
           const std::function<void(const LadderStep&)>& step);
  /// The picture of a single run to `spp`, and its seconds.
  LadderStep run(std::uint64_t seed, std::uint64_t spp);

  /// Of all runs so far: kernels, memory, passes, counters.
  void describe(StudyOption& option) const;
  const Integrator& method() const { return *method_; }
  const std::string& precision() const { return precision_; }
  RenderOptions& options() { return options_; }
  double radius() const;  ///< of the first pass, in scene units; 0: it merges nothing
  /// Wall seconds that one more run to `spp` will take, by all runs so far.
  double cost(std::uint64_t spp) const;
  /// The most samples per pixel of a run that takes no longer than `seconds`; 0: not even its
  /// start.
  double spp_in(double seconds) const;

 private:
  void account(const Session& session, std::uint64_t spp);

  const StudyStage* stage_;
  const Integrator* method_;
  std::string precision_;
  double radius_factor_ = 1;
  RenderOptions options_;
  /// Wall seconds beside rendering: the least of any run, since the first builds kernels.
  double overhead_ = std::numeric_limits<double>::max();
  double wall_ = 0;  ///< of rendering, in all
  double setup_seconds_ = 0;
  int runs_ = 0;
  std::uint64_t wrong_ = 0, memory_bytes_ = 0, spp_ = 0;
  std::vector<PassSeconds> passes_;  ///< sums
};

}  // namespace pellucid

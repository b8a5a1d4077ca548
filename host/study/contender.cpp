// Runs of a contender, with its own account of time.
#include "study/contender.h"

#include <algorithm>

#include "base/clock.h"
#include "base/timer.h"

namespace pellucid {

Contender::Contender(const StudyStage& stage, const Integrator& method,
                     const std::string& precision)
    : stage_(&stage), method_(&method), precision_(precision), options_(stage.options) {
  if (precision == "compact")
    options_.plan.compact_vertices = true;
  else
    options_.plan.float_mode = find_float_mode(precision);
}

Contender Contender::with_radius(double factor) const {
  Contender other = *this;
  other.options_.radius = factor * radius();
  other.radius_factor_ = factor * radius_factor_;
  return other;
}

double Contender::radius() const {
  if (!method_->wishes.has(INTG_MERGE)) return 0;
  return options_.radius.value_or(default_radius(stage_->packed, options_.light_path_count()));
}

void Contender::run(std::uint64_t seed, const std::vector<std::uint64_t>& ladder,
                    const std::function<void(const LadderStep&)>& step) {
  const Timer whole;
  const DeviceInfo& info = stage_->device.info();
  const Clock clock{info.cpu, device_cores(info)};
  options_.seed = seed;
  options_.passes = PassRange{0, ladder.front()};
  Session session(stage_->device, stage_->packed, *method_, options_);
  if (runs_ == 0) setup_seconds_ = session.kernel_seconds();
  RenderHooks hooks;
  hooks.stop = stage_->stop;
  LadderStep at;
  for (std::uint64_t spp : ladder) {
    session.set_passes({0, spp});
    bool complete = true;
    at.rung.seconds += clock([&] {
      const double before = session.render_seconds();
      complete = session.run(hooks);
      return session.render_seconds() - before;
    });
    if (!complete || stage_->stop()) throw StudyStopped();
    at.rung.spp = spp;
    at.rung.wall_seconds = session.render_seconds();
    at.picture = film_image(session.film(), false, false).data;
    step(at);
  }
  overhead_ = std::min(overhead_, whole.seconds() - at.rung.wall_seconds);
  wall_ += at.rung.wall_seconds;
  account(session, ladder.back());
}

LadderStep Contender::run(std::uint64_t seed, std::uint64_t spp) {
  LadderStep last;
  run(seed, {spp}, [&](const LadderStep& step) { last = step; });
  return last;
}

double Contender::cost(std::uint64_t spp) const {
  return overhead_ + double(spp) * wall_ / double(spp_);
}

double Contender::spp_in(double seconds) const {
  return std::max(0.0, (seconds - overhead_) / (wall_ / double(spp_)));
}

void Contender::account(const Session& session, std::uint64_t spp) {
  ++runs_;
  spp_ += spp;
  wrong_ += error_count(session.counters());
  memory_bytes_ = 0;
  for (const auto& [buffer, bytes] : session.plan().memory()) memory_bytes_ += bytes;
  for (const PassState& p : session.plan().passes()) {
    const auto same = std::find_if(passes_.begin(), passes_.end(),
                                   [&](const PassSeconds& row) { return row.name == p.pass.name; });
    if (same == passes_.end())
      passes_.push_back({p.pass.name, p.time->seconds});
    else
      same->seconds += p.time->seconds;
  }
}

void Contender::describe(StudyOption& option) const {
  option.integrator = method_->name;
  option.precision = precision_;
  option.merges = method_->wishes.has(INTG_MERGE);
  option.radius_alpha = option.merges ? options_.radius_alpha : 1;
  option.radius = radius();
  option.radius_factor = radius_factor_;
  option.setup_seconds = setup_seconds_;
  option.memory_bytes = memory_bytes_;
  option.wrong = wrong_;
  option.passes = passes_;
  for (PassSeconds& pass : option.passes) pass.seconds /= double(std::max<std::uint64_t>(spp_, 1));
}

}  // namespace pellucid

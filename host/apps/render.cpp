// render: from a scene to pictures.
#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <filesystem>
#include <future>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/common.h"
#include "apps/dry_run.h"
#include "apps/outputs.h"
#include "apps/render_options.h"
#include "apps/render_report.h"
#include "apps/replay_report.h"
#include "apps/scene_input.h"
#include "base/files.h"
#include "base/log.h"
#include "base/phase_clock.h"
#include "base/signals.h"
#include "base/text.h"
#include "base/timer.h"
#include "integrators/registry.h"
#include "render/aov.h"
#include "render/launch.h"

namespace pellucid {
namespace {

/// A render under way, and all that has to be kept of it.
class RenderJob {
 public:
  RenderJob(const RenderFlags& flags, const CommonOptions& common)
      : flags_(flags), common_(common) {}
  ExitCode run();

 private:
  void check_outputs() const;
  void prepare();
  std::optional<Film> resumed_film();
  bool render_aov_channels(const Device& target);
  bool render(Session& session);
  void write(const Film& film, bool pictures);
  void write_pictures_of(const Film& film);
  void write_checkpoint_of(const Film& film);
  void list_fireflies(const Device& target, const Film& film);
  ExitCode tell_replay(const Device& target);
  ExitCode finish(bool complete);

  const RenderFlags& flags_;
  const CommonOptions& common_;
  StopSignal stop_;
  Scene scene_;
  Integrator method_;  ///< with layers
  RenderFacts facts_;
  std::vector<std::string> names_;
  std::vector<AovChannel> aovs_;
  std::vector<FireflyReplay> fireflies_;
  SamplePlace replayed_;
  std::optional<Checkpoint> earlier_;  ///< what --resume found, without its film
};

/// What cannot be written must show before the render, not after it, and nothing may overwrite the
/// scene, the checkpoint or another result.
void RenderJob::check_outputs() const {
  std::vector<std::pair<std::string, std::string>> files;  // what it is, name
  for (const std::string& name : names_) files.emplace_back("-o", name);
  files.emplace_back("--atlas", flags_.atlas);
  files.emplace_back("--grid", flags_.grid);
  files.emplace_back("--checkpoint", flags_.checkpoint);
  files.emplace_back("--stats", flags_.stats);
  if (common_.json != "-") files.emplace_back("--json", common_.json);
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto& [what, name] = files[i];
    if (name.empty()) continue;
    for (const SourceFile& source : scene_.files)
      if (same_file(name, source.path))
        throw UsageError(fmt::format("{} '{}' would overwrite a file of the scene", what, name));
    for (std::size_t k = 0; k < i; ++k)
      if (same_file(name, files[k].second))
        throw UsageError(fmt::format("{} '{}' and {} '{}' are the same file; name another", what,
                                     name, files[k].first, files[k].second));
    check_writable(name);
  }
}

/// Loads the scene and settles what will be rendered.
void RenderJob::prepare() {
  const PhaseScope phase(Phase::load);
  flags_.check();
  flags_.device.limit();
  scene_ = open_scene(flags_.scene, flags_.load_options());
  flags_.override_settings(scene_.settings);
  facts_.scene = &scene_;
  method_ = flags_.method(scene_);
  facts_.integrator = &method_;
  facts_.options = flags_.options(scene_, *facts_.integrator);
  names_ = flags_.output_names(scene_);
  if (flags_.strict && !scene_.warnings.empty())
    throw InputError("--strict: the warnings above are errors");
  facts_.scene_hash = scene_hash(scene_);
  facts_.kernels_hash = kernels_hash(*facts_.integrator, flags_.kernel_dir);
  if (flags_.replay.empty())
    check_outputs();
  else
    replayed_ = parse_sample("--replay", flags_.replay, facts_.options.window());
}

/// The film of the checkpoint that --resume names, if it is there.
std::optional<Film> RenderJob::resumed_film() {
  const PhaseScope phase(Phase::checkpoint);
  if (flags_.checkpoint.empty() || !std::filesystem::exists(flags_.checkpoint)) {
    if (flags_.resume) log_info("'{}' does not exist yet: a new render", flags_.checkpoint);
    return std::nullopt;
  }
  if (!flags_.resume)
    throw UsageError(fmt::format(
        "--checkpoint: '{}' exists; go on with it by --resume, or remove it", flags_.checkpoint));
  earlier_ = read_checkpoint(flags_.checkpoint);
  const std::string what = difference(earlier_->facts.identity, identity(facts_));
  if (!what.empty())
    throw InputError(
        fmt::format("checkpoint '{}' (the one) is not of this render (the other): {}; repeat its "
                    "options, or name another file with --checkpoint",
                    flags_.checkpoint, what));
  facts_.options.known_error = known_error(earlier_->facts.evidence);
  const PassSet& done = earlier_->film.passes;
  const auto& wanted = facts_.options.passes;
  log_info("going on with '{}', which has passes {}{}", flags_.checkpoint, done.text(),
           wanted && done.contains(*wanted) ? "; all that is asked for is done" : "");
  return std::move(earlier_->film);
}

void RenderJob::write_pictures_of(const Film& film) {
  const auto asked = [&](const char* aov) {
    return std::find(flags_.aovs.begin(), flags_.aovs.end(), aov) != flags_.aovs.end();
  };
  Image image = film_image(film, asked("variance"), asked("samples"));
  add_channels(image, aovs_);
  image.metadata = lasting_evidence(facts_);
  add_progress(film, facts_.film, facts_.session->counters(), facts_.session->cuts(),
               facts_.render_seconds, image.metadata);
  if (facts_.session->error()) add_error(film, *facts_.session->error(), image.metadata);
  if (flags_.deterministic) make_deterministic(image.metadata);
  write_pictures(names_, image, flags_.display.transform());
}

void RenderJob::write_checkpoint_of(const Film& film) {
  const PhaseScope phase(Phase::checkpoint);
  Evidence evidence = lasting_evidence(facts_);
  if (facts_.session->error()) add_error(film, *facts_.session->error(), evidence);
  write_checkpoint(flags_.checkpoint, film,
                   {identity(facts_), evidence, facts_.session->counters(), facts_.session->cuts(),
                    facts_.render_seconds, aovs_});
}

/// Writes the checkpoint and, if wanted, the pictures; if one fails, the others are still written.
void RenderJob::write(const Film& film, bool pictures) {
  const PhaseScope phase(Phase::write);
  if (pictures) facts_.film = summarise(film);
  facts_.render_seconds =
      facts_.session->render_seconds() + (earlier_ ? earlier_->facts.seconds : 0.0);
  std::exception_ptr first;
  const auto attempt = [&](const auto& step) {
    try {
      step();
    } catch (const OutputError&) {
      if (!first) first = std::current_exception();
    }
  };
  if (!flags_.checkpoint.empty()) attempt([&] { write_checkpoint_of(film); });
  if (pictures) attempt([&] { write_pictures_of(film); });
  if (pictures && !flags_.atlas.empty())
    attempt([&] { write_image(flags_.atlas, film_atlas(film)); });
  if (pictures && !flags_.grid.empty()) attempt([&] { write_image(flags_.grid, film_grid(film)); });
  if (first) std::rethrow_exception(first);
}

/// What --aov asks of the AOV pass; before the render, so that the scene is on the device once.
/// False if stopped early.
bool RenderJob::render_aov_channels(const Device& target) {
  if (flags_.aovs.empty()) return true;
  const PhaseScope phase(Phase::aov);
  Progress progress("rendering AOVs");
  std::vector<Counter> counters = make_counters();
  const auto stop = [&] {
    stop_.reinstall();  // the kernel may have been built by the launch before
    return stop_.stop_requested();
  };
  auto channels = render_aovs(target, *facts_.packed, flags_.aovs, facts_.options, counters, stop);
  if (!channels) return false;
  aovs_ = std::move(*channels);
  const std::string wrong = describe_counters(counters);
  if (flags_.strict && error_count(counters) > 0) throw NumericError("--strict: AOVs: " + wrong);
  if (!wrong.empty()) log_warn("device counters of the AOVs: {}", wrong);
  return true;
}

/// Renders with progress and signals; false if stopped early. Writes the picture on SIGUSR1 and the
/// checkpoint from time to time.
bool RenderJob::render(Session& session) {
  const PhaseScope phase(Phase::render);
  Progress progress(fmt::format("{} on {}", facts_.integrator->name, facts_.device->spec()));
  const double period = flags_.checkpoint_period();
  Timer since_checkpoint;
  bool picture = false;
  RenderHooks hooks;
  hooks.stop = [&] { return stop_.stop_requested(); };
  hooks.progress = [&](const std::string& text) { progress.update(text); };
  hooks.wants_film = [&] {
    picture = stop_.take_write_request();
    return picture || (!flags_.checkpoint.empty() && since_checkpoint.seconds() >= period);
  };
  hooks.film = [&](const Film& film) {
    try {
      write(film, picture);
      if (picture) log_info("the image so far is written");
    } catch (const OutputError& e) {  // the render is worth more than this look at it
      log_warn("{}; the render goes on", e.what());
    }
    since_checkpoint = Timer();
  };
  return session.run(hooks);
}

/// --fireflies: finds the samples in the film and traces each again.
void RenderJob::list_fireflies(const Device& target, const Film& film) {
  const PhaseScope phase(Phase::write);
  Progress progress("replaying");
  for (const Firefly& f : fireflies(film, flags_.fireflies)) {
    if (stop_.stop_requested()) return;
    progress.update(fmt::format("{} of {}", fireflies_.size() + 1, flags_.fireflies));
    fireflies_.push_back({f, replay(target, *facts_.packed, flags_.plain_method(scene_),
                                    facts_.options, f.x, f.y, f.pass)});
  }
}

/// --replay: one sample instead of a picture.
ExitCode RenderJob::tell_replay(const Device& target) {
  const Replay found = replay(target, *facts_.packed, method_, facts_.options, replayed_.x,
                              replayed_.y, replayed_.pass);
  nlohmann::json document = replay_json(found, scene_);
  document["scene"] = scene_.name;
  document["scene_hash"] = facts_.scene_hash;
  document["integrator"] = method_.name;
  document["seed"] = facts_.options.seed;
  write_json(common_.json, document);
  if (common_.wants_text()) print_result(replay_text(found, scene_));
  return ExitCode::done;
}

ExitCode RenderJob::finish(bool complete) {
  const PhaseScope phase(Phase::write);
  const RenderFacts& f = facts_;
  const double paths = double(f.film.iterations) * double(f.options.window().pixels());
  log_info("{} spp of {}x{} by {} in {}: {:.2f} Mpaths/s, {:.2f} Mrays/s{}", f.film.iterations,
           f.options.window().width, f.options.window().height, f.integrator->name,
           format_seconds(f.render_seconds), 1e-6 * paths / f.render_seconds,
           1e-6 * double(f.film.rays) / f.render_seconds,
           std::isfinite(f.film.relmse)
               ? fmt::format(", noise about {:.2g} %", 100 * std::sqrt(f.film.relmse))
               : "");
  const std::string counters = describe_counters(f.session->counters());
  if (!counters.empty()) log_warn("device counters: {}", counters);
  const std::string cut = cuts_verdict(f.session->cuts());
  if (!cut.empty()) log_info("{}", cut);  // asked for: no warning
  if (!complete) log_warn("stopped early; what was rendered is written");
  // No warning: nothing went wrong, and --strict takes none. It stays in the picture's evidence.
  for (const std::string& unseen :
       f.options.error ? error_unknown(f) : blind_spots(*f.integrator, f.optics(), integrators()))
    log_info("{}", unseen);
  const bool missed = f.session->error() && !f.session->error()->reached();
  if (f.session->error()) {
    const std::string verdict = error_verdict(*f.session->error());
    if (missed && complete)
      log_error("--error: {}", verdict);
    else
      log_info("{}", verdict);
  }
  nlohmann::json document = render_stats(f);
  document["outputs"] = flags_.results(names_);
  document["complete"] = complete;
  if (flags_.fireflies) document["fireflies"] = fireflies_json(fireflies_, scene_);
  write_json(flags_.stats, document);
  write_json(common_.json, document);
  if (common_.wants_text())
    for (const std::string& name : flags_.results(names_)) print_result(name + "\n");
  if (common_.wants_text() && flags_.fireflies) print_result(fireflies_text(fireflies_));
  if (flags_.strict && error_count(f.session->counters()) > 0)
    throw NumericError("--strict: " + counters);
  if (!complete) return ExitCode::stopped;
  return missed ? ExitCode::gate_failed : ExitCode::done;
}

ExitCode RenderJob::run() {
  prepare();
  const PhaseScope rest(Phase::device);  // and whatever is in no other
  std::optional<Film> start = resumed_film();
  // A broken installation must show before the render, not after it; loading takes as long as
  // opening the device and finding kernels in the cache, so it goes on beside them.
  std::future<void> image_library = std::async(std::launch::async, load_image_library);
  const Device target = flags_.device.open();
  // Building a BVH is wasted time if not even the film fits.
  const RenderOptions& o = facts_.options;
  plan_memory(target.info(), {}, *facts_.integrator, o);
  facts_.device = &target.info();

  const PackedScene packed = [&] {
    const PhaseScope phase(Phase::bvh);
    Progress progress("building BVH");
    return pack_scene(scene_, {simd_width_for(target.info())});
  }();
  facts_.packed = &packed;
  facts_.options.least_effective = least_effective(*facts_.integrator, facts_.optics());
  if (o.radius) check_radius(packed, *o.radius);
  if (flags_.dry_run) {
    image_library.get();
    tell_plan(facts_, flags_.results(names_), common_);
    return ExitCode::done;
  }
  if (!flags_.replay.empty()) {
    image_library.get();
    return tell_replay(target);
  }
  if (!render_aov_channels(target)) {
    log_warn("stopped early, in the AOVs and before the first pass: nothing is written");
    return ExitCode::stopped;
  }
  if (earlier_) add_missing(aovs_, earlier_->facts.aovs);
  auto session = [&] {
    const PhaseScope phase(Phase::film);  // but for kernels
    Progress progress("building kernels");
    return Session(target, packed, *facts_.integrator, facts_.options, std::move(start));
  }();
  facts_.session = &session;
  if (earlier_) session.add_counters(earlier_->facts.counters, earlier_->facts.cuts);
  stop_.reinstall();
  image_library.get();

  const bool complete = render(session);
  write(session.film(), true);
  if (flags_.fireflies) list_fireflies(target, session.film());
  return finish(complete);
}

}  // namespace

CommandRun setup_render(CLI::App& app) {
  auto flags = std::make_shared<RenderFlags>();
  flags->declare(app);
  return [flags](const CommonOptions& common) { return RenderJob(*flags, common).run(); };
}

}  // namespace pellucid

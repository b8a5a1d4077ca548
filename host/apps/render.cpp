// render: from a scene to pictures.
#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/common.h"
#include "apps/outputs.h"
#include "apps/render_options.h"
#include "apps/render_report.h"
#include "apps/scene_input.h"
#include "base/files.h"
#include "base/log.h"
#include "base/signals.h"
#include "base/text.h"
#include "base/timer.h"
#include "integrators/reach.h"
#include "integrators/registry.h"

namespace pellucid {
namespace {

struct RenderCommand : RenderFlags {
  ExitCode run(const CommonOptions& common) const;

 private:
  void check_outputs(const std::vector<std::string>& names, const CommonOptions& common) const;
  Device open_device(RenderFacts& facts) const;
  ExitCode finish(const RenderFacts& facts, const std::vector<std::string>& names, bool complete,
                  const CommonOptions& common) const;
};

/// Writes every output of a film; facts carry the evidence.
void write_outputs(const std::vector<FilmPixel>& film, const std::vector<std::string>& names,
                   const std::vector<std::string>& aovs, bool deterministic,
                   const RenderFacts& facts) {
  const auto asked = [&](const char* aov) {
    return std::find(aovs.begin(), aovs.end(), aov) != aovs.end();
  };
  Image image = film_image(film, facts.options.width, facts.options.height, asked("variance"),
                           asked("samples"));
  add_evidence(facts, deterministic, image);
  write_pictures(names, image);
}

void log_result(const RenderFacts& f) {
  log_info("{} spp of {}x{} by {} in {}: {:.2f} Mpaths/s, {:.2f} Mrays/s{}", f.film.iterations,
           f.options.width, f.options.height, f.integrator->name, format_seconds(f.seconds.render),
           1e-6 * double(f.film.iterations) * f.options.width * f.options.height / f.seconds.render,
           1e-6 * double(f.film.rays) / f.seconds.render,
           std::isfinite(f.film.relmse)
               ? fmt::format(", noise about {:.2g} %", 100 * std::sqrt(f.film.relmse))
               : "");
  const std::string counters = describe_counters(f.session->counters());
  if (!counters.empty()) log_warn("device counters: {}", counters);
}

/// Renders with progress and signals; false if stopped early. Writes the image on SIGUSR1.
bool render_with_progress(Session& session, StopSignal& stop, const std::string& title,
                          const std::function<void(const std::vector<FilmPixel>&)>& write) {
  Progress progress(title);
  RenderHooks hooks;
  hooks.stop = [&] { return stop.stop_requested(); };
  hooks.progress = [&](const std::string& text) { progress.update(text); };
  hooks.wants_image = [&] { return stop.take_write_request(); };
  hooks.image = [&](const std::vector<FilmPixel>& film) {
    try {
      write(film);
      log_info("the image so far is written");
    } catch (const OutputError& e) {  // the render is worth more than this look at it
      log_warn("{}; the render goes on", e.what());
    }
  };
  return session.run(hooks);
}

/// What cannot be written must show before the render, not after it.
void RenderCommand::check_outputs(const std::vector<std::string>& names,
                                  const CommonOptions& common) const {
  for (const std::string& name : names) check_writable(name);
  if (!stats.empty()) check_writable(stats);
  if (!common.json.empty() && common.json != "-") check_writable(common.json);
}

/// The device, if the film fits into it, and what it decides about the options.
Device RenderCommand::open_device(RenderFacts& facts) const {
  Device target = Device::open(device);
  RenderOptions& o = facts.options;
  const std::size_t pixels = std::size_t(o.width) * std::size_t(o.height);
  check_memory(target.info(), plan_memory({}, *facts.integrator, pixels));
  return target;
}

ExitCode RenderCommand::finish(const RenderFacts& facts, const std::vector<std::string>& names,
                               bool complete, const CommonOptions& common) const {
  log_result(facts);
  if (!complete) log_warn("stopped early; what was rendered is written");
  for (const std::string& what : unreachable_paths(*facts.integrator, facts.packed->features))
    log_info("'{}' cannot see {}", facts.integrator->name, what);
  nlohmann::json document = render_stats(facts);
  document["outputs"] = names;
  document["complete"] = complete;
  write_json(stats, document);
  write_json(common.json, document);
  if (common.wants_text())
    for (const std::string& name : names) print_result(name + "\n");
  if (strict && error_count(facts.session->counters()) > 0)
    throw NumericError("--strict: " + describe_counters(facts.session->counters()));
  return complete ? ExitCode::done : ExitCode::stopped;
}

ExitCode RenderCommand::run(const CommonOptions& common) const {
  const Timer total;
  check();
  StopSignal stop;
  RenderFacts facts;
  Scene s = open_scene(scene);
  if (!size.empty()) std::tie(s.settings.width, s.settings.height) = parse_size("--size", size);
  const Integrator& method = choose_integrator(integrator, s);
  facts.options = options(s, method);
  const std::vector<std::string> names = output_names(s);
  if (strict && !s.warnings.empty()) throw InputError("--strict: the warnings above are errors");
  facts.scene = &s;
  facts.integrator = &method;
  facts.scene_hash = scene_hash(s);
  check_outputs(names, common);
  // A broken installation must show before the render, not after it; loading takes as long as
  // opening the device and finding kernels in the cache, so it goes on beside them.
  std::future<void> image_library = std::async(std::launch::async, load_image_library);
  const Device target = open_device(facts);
  facts.device = &target.info();
  facts.seconds.load = total.seconds();

  Timer phase;
  const PackedScene packed = [&] {
    Progress progress("building BVH");
    return pack_scene(s, {simd_width_for(target.info())});
  }();
  facts.packed = &packed;
  facts.seconds.bvh = phase.seconds();
  auto session = [&] {
    Progress progress("building kernels");
    return Session(target, packed, method, facts.options);
  }();
  facts.session = &session;
  stop.reinstall();
  facts.seconds.kernels = session.kernel_seconds();
  phase = Timer();
  image_library.get();
  facts.seconds.load += phase.seconds();

  const auto write = [&](const std::vector<FilmPixel>& film) {
    facts.film = summarise(film);
    facts.seconds.render = session.render_seconds();
    write_outputs(film, names, aovs, deterministic, facts);
  };
  const std::string title = fmt::format("{} on {}", method.name, target.info().spec());
  const bool complete = render_with_progress(session, stop, title, write);
  phase = Timer();
  write(session.film());
  facts.seconds.write = phase.seconds();
  facts.seconds.total = total.seconds();
  return finish(facts, names, complete, common);
}

}  // namespace

CommandRun setup_render(CLI::App& app) {
  auto command = std::make_shared<RenderCommand>();
  command->declare(app);
  return [command](const CommonOptions& common) { return command->run(common); };
}

}  // namespace pellucid

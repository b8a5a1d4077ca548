// render: from a scene to pictures.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <future>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/common.h"
#include "apps/outputs.h"
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

/// CLI11 would take -1 and all that is too large for 2^64 - 1.
std::string whole_number(const std::string& text) {
  std::uint64_t value = 0;
  const char* const text_end = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), text_end, value);
  const bool whole = error == std::errc() && end == text_end;
  return whole ? "" : fmt::format("takes a whole number such as 7, not '{}'", text);
}

struct RenderCommand {
  std::string scene, integrator, mis = "balance", time, size, device, features = "auto", kernel_dir,
                                 stats;
  std::vector<std::string> outputs, aovs;
  std::uint64_t spp = 0, seed = 0, max_depth = 0, group = 0;
  bool strict = false, deterministic = false;

  void declare(CLI::App& app);
  ExitCode run(const CommonOptions& common) const;

 private:
  RenderOptions options(const Scene& scene, const Integrator& method) const;
  std::vector<std::string> output_names(const Scene& scene) const;
  void check_aovs() const;
  void check_outputs(const std::vector<std::string>& names, const CommonOptions& common) const;
  Device open_device(RenderFacts& facts) const;
  ExitCode finish(const RenderFacts& facts, const std::vector<std::string>& names, bool complete,
                  const CommonOptions& common) const;
};

void RenderCommand::declare(CLI::App& app) {
  app.add_option("SCENE", scene, "scene file (.json), or the name of a shipped scene")->required();
  std::string methods;
  for (const Integrator& i : integrators())
    methods += fmt::format("{}{}: {}", methods.empty() ? "" : "; ", i.name, i.summary);
  app.add_option("-i,--integrator", integrator, methods + ". Default: the scene's, else path")
      ->type_name("NAME");
  app.add_option("--mis", mis, "how `path` weighs its two strategies: balance, power or max")
      ->type_name("RULE");
  app.add_option("--spp", spp, "samples per pixel (default: the scene's, else 64)")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{0xffffffff}));
  app.add_option("--time", time,
                 "stop after this long, e.g. 60s or 10m; with --spp, whichever is first")
      ->type_name("DURATION");
  app.add_option("--seed", seed, "random seed (default 0)")->check(whole_number);
  app.add_option("--size", size, "image size in pixels, e.g. 640x480 (default: the scene's)")
      ->type_name("WxH");
  app.add_option("--max-depth", max_depth,
                 "longest path in segments, an emitter seen directly has 1 (default: the scene's, "
                 "else unlimited)")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{0xfffffffe}));
  app.add_option(
         "-o,--output", outputs,
         "picture to write, type by suffix; repeatable (default: SCENE.exr and SCENE.png here)")
      ->type_name("FILE")
      ->allow_extra_args(false);
  app.add_option("--aov", aovs, "further EXR channels: variance (of each pixel's mean), samples")
      ->type_name("LIST")
      ->delimiter(',');
  app.add_option("--device", device, "OpenCL device: index as in `devices`, or part of its name")
      ->type_name("SPEC")
      ->envname("PELLUCID_DEVICE");
  app.add_option(
         "--features", features,
         "what kernels hold: auto (what the scene needs), all, or a list like +phong,+disks")
      ->type_name("LIST");
  app.add_option("--work-group", group,
                 "work-items per group; changes speed, never the image (default 64)")
      ->check(CLI::Range(1, 4096));
  app.add_option("--kernel-dir", kernel_dir, "read kernels from this folder instead of the program")
      ->type_name("DIR");
  app.add_option("--stats", stats, "write statistics of the render as JSON")->type_name("FILE");
  app.add_flag("--strict", strict, "device counters and warnings are errors");
  app.add_flag("--deterministic", deterministic, "leave time, host and device out of the image");
  app.footer("Example: pellucid render cornell-box --spp 128 -o box.exr -o box.png");
}

uint parse_mis(const std::string& text, const Integrator& method) {
  if (text != "balance" && text != "power" && text != "max")
    throw UsageError("--mis: '" + text + "' is none of balance, power, max." +
                     did_you_mean(text, {"balance", "power", "max"}));
  if (text != "balance" && !method.weighs)
    throw UsageError("--mis " + text + " has no effect on '" + method.name +
                     "', which combines nothing");
  return text == "power" ? MIS_POWER : text == "max" ? MIS_MAX : MIS_BALANCE;
}

RenderOptions RenderCommand::options(const Scene& s, const Integrator& method) const {
  constexpr std::uint64_t default_spp = 64;
  RenderOptions o;
  o.width = s.settings.width;
  o.height = s.settings.height;
  if (!time.empty()) o.seconds = parse_duration("--time", time);
  if (spp) o.spp = spp;
  if (!o.spp && !o.seconds) o.spp = s.settings.spp ? std::uint64_t(*s.settings.spp) : default_spp;
  o.seed = seed;
  if (max_depth) o.max_depth = uint(max_depth);
  if (!max_depth && s.settings.max_depth) o.max_depth = uint(*s.settings.max_depth);
  o.mis = parse_mis(mis, method);
  o.plan.extra_features = parse_feature_request(features);
  o.plan.kernel_dir = kernel_dir;
  o.plan.group = group;
  return o;
}

std::vector<std::string> RenderCommand::output_names(const Scene& s) const {
  if (outputs.empty()) return {s.name + ".exr", s.name + ".png"};
  check_picture_types(outputs);
  return outputs;
}

void RenderCommand::check_aovs() const {
  for (const std::string& aov : aovs)
    if (aov != "variance" && aov != "samples")
      throw UsageError("--aov: there is no '" + aov + "'; there are variance, samples." +
                       did_you_mean(aov, {"variance", "samples"}));
}

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
  check_aovs();
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

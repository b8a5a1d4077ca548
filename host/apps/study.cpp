// study: what accuracy costs in time on a scene, for every method and precision.
#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/common.h"
#include "apps/device_input.h"
#include "apps/outputs.h"
#include "apps/render_options.h"
#include "apps/render_report.h"
#include "apps/scene_input.h"
#include "base/files.h"
#include "base/log.h"
#include "base/signals.h"
#include "base/text.h"
#include "base/version.h"
#include "integrators/registry.h"
#include "render/launch.h"
#include "study/analyse.h"
#include "study/checks.h"
#include "study/machine_load.h"
#include "study/report/html.h"
#include "study/report/table.h"
#include "study/runner.h"
#include "study/study_json.h"

namespace pellucid {
namespace {

const std::vector<std::string> PRECISIONS{"strict", "mad", "fast", "compact"};

struct StudyCommand {
  std::string scene, target = "1%", budget = "10m", methods = "all", precisions = "all", size, crop,
                     reference, folder, report, memory, kernel_dir, mis = "balance",
                     sampler = "sobol", radius, radius_alpha;
  std::vector<std::string> overrides;
  std::uint64_t seed = 0, max_depth = 0, light_paths = 0;
  DeviceFlags device;

  ExitCode run(const CommonOptions& common);

 private:
  StudyRequest request() const;
  void set_size(Scene& scene) const;
  void check_effect(const std::vector<std::string>& methods) const;
  RenderOptions options(const Scene& scene) const;
  void make_folder() const;
  Study measure(bool& stopped);
  void put_document(const Study& study) const;
  void write(const Study& study, const CommonOptions& common) const;
};

/// Names from a list by comma, or all of them. Throws UsageError.
std::vector<std::string> choose(const std::string& option, const std::string& text,
                                const std::vector<std::string>& names) {
  if (text == "all") return names;
  std::vector<std::string> chosen;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    const std::string word = text.substr(start, end - start);
    if (std::find(names.begin(), names.end(), word) == names.end())
      throw UsageError(fmt::format("{}: '{}' is none of all, {}.{}", option, word, join(names),
                                   did_you_mean(word, names)));
    if (std::find(chosen.begin(), chosen.end(), word) == chosen.end()) chosen.push_back(word);
    start = end + 1;
  }
  return chosen;
}

void name_machine(const DeviceInfo& info, StudyMachine& machine) {
  machine.device = info.name;
  machine.driver = info.platform_name + " " + info.driver;
  machine.version = std::string(version()) + " " + commit();
  machine.clock = info.cpu ? "cpu" : "wall";
  machine.threads = unsigned(device_cores(info));
}

void warn_if_busy() {
  const double load = foreign_load_now();
  if (load > DISTURBING_LOAD)
    log_warn("other programs take {:.0f} % of the machine: what is measured now is disturbed",
             100 * load);
}

StudyRequest StudyCommand::request() const {
  StudyRequest r;
  r.target = parse_fraction("--target", target);
  if (!(r.target > 0 && r.target <= 1))
    throw UsageError("--target takes an error above 0 and up to 100%, not '" + target + "'");
  r.budget_seconds = parse_duration("--budget", budget);
  if (!(r.budget_seconds >= 1))
    throw UsageError("--budget takes a second at least, not '" + budget + "'");
  std::vector<std::string> names;
  for (const Integrator& method : integrators()) names.push_back(method.name);
  r.integrators = choose("--integrators", methods, names);
  if (methods == "all")  // slow by design, for tests
    r.integrators.erase(std::find(r.integrators.begin(), r.integrators.end(), "reference"));
  r.precisions = choose("--precision", precisions, PRECISIONS);
  check_effect(r.integrators);
  r.reference = reference;
  r.seed = seed;
  r.folder = folder;
  return r;
}

/// Throws UsageError where an option concerns none of the methods.
void StudyCommand::check_effect(const std::vector<std::string>& names) const {
  bool merges = false, walks = false, weighs = false;
  for (const std::string& name : names) {
    const Integrator& method = find_integrator(name);
    merges |= method.wishes.has(INTG_MERGE);
    walks |= method.walks_from_lights();
    weighs |= method.weighs;
  }
  const auto need = [](bool given, bool has, const char* option, const char* what) {
    if (given && !has)
      throw UsageError(fmt::format("{} has no effect: none of --integrators {}", option, what));
  };
  need(!radius.empty(), merges, "--radius", "merges");
  need(!radius_alpha.empty(), merges, "--radius-alpha", "merges");
  need(light_paths > 0, walks, "--light-paths", "traces paths from lights");
  need(mis != "balance", weighs, "--mis", "weighs strategies");
}

/// As asked for; else the scene's shape in so many pixels as replicates in minutes allow.
void StudyCommand::set_size(Scene& s) const {
  RenderSettings& settings = s.settings;
  if (!size.empty()) {
    std::tie(settings.width, settings.height) = parse_size("--size", size);
    return;
  }
  constexpr double most = 96.0 * 96.0;
  const double shrink = std::sqrt(most / (double(settings.width) * double(settings.height)));
  if (!crop.empty() || !reference.empty() || shrink >= 1) return;
  settings.width = std::max(1, int(std::lround(settings.width * shrink)));
  settings.height = std::max(1, int(std::lround(settings.height * shrink)));
}

RenderOptions StudyCommand::options(const Scene& s) const {
  RenderOptions o;
  o.width = s.settings.width, o.height = s.settings.height;
  if (!crop.empty()) o.crop = parse_crop("--crop", crop, o.width, o.height);
  if (max_depth)
    o.max_depth = uint(max_depth);
  else if (s.settings.max_depth)
    o.max_depth = uint(*s.settings.max_depth);
  if (!memory.empty()) o.memory = parse_bytes("--memory", memory);
  if (mis == "power") o.mis = MIS_POWER;
  if (light_paths) o.light_paths = uint(light_paths);
  if (!radius.empty()) o.radius = parse_radius(radius);
  if (!radius_alpha.empty()) o.radius_alpha = parse_radius_alpha(radius_alpha);
  o.plan.sampler = find_sampler(sampler);
  o.plan.kernel_dir = kernel_dir;
  return o;
}

void StudyCommand::make_folder() const {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw OutputError(fmt::format("--out {}: cannot make the folder: {}", folder, error.message()));
  for (const char* name : {"study.json", "table.md", "report.html"})
    check_writable(folder + "/" + name);
}

Study StudyCommand::measure(bool& stopped) {
  if (folder.empty()) folder = ".";
  StudyRequest r = request();
  device.limit();
  Scene s = open_scene(scene, {overrides, {}});
  set_size(s);
  RenderOptions o = options(s);
  o.host_bytes = study_host_bytes(o.window().pixels(), r.integrators.size());
  make_folder();
  const Device target_device = device.open();
  load_image_library();
  const PackedScene packed = pack_scene(s, {simd_width_for(target_device.info())});
  warn_if_busy();
  StopSignal stop;
  Progress progress("study");
  const StudyStage stage{target_device, packed, o, [&] { return stop.stop_requested(); }};
  r.tell = [&](const std::string& text) {
    stop.reinstall();  // kernels may have been built since
    progress.update(text);
  };
  r.scene_hash = scene_hash(s), r.settings = settings_text(s, o);
  const auto finish = [&](Study& study) {
    study.scene = s.name, study.scene_hash = r.scene_hash, study.settings = r.settings;
    study.warnings.insert(study.warnings.begin(), s.warnings.begin(), s.warnings.end());
    name_machine(target_device.info(), study.machine);
    analyse(study);
  };
  r.save = [&](Study so_far) {
    so_far.complete = false;
    finish(so_far);
    put_document(so_far);
  };
  Study study = run_study(stage, optics_of(packed, o.max_depth), r);
  stopped = !study.complete;
  finish(study);
  return study;
}

/// study.json, or a warning where that is not to be had now: the run goes on.
void StudyCommand::put_document(const Study& study) const {
  try {
    write_text_atomic((std::filesystem::path(folder) / "study.json").string(),
                      study_document(study).dump(1) + "\n");
  } catch (const OutputError& error) {
    log_warn("what was measured so far is not kept: {}", error.what());
  }
}

void StudyCommand::write(const Study& study, const CommonOptions& common) const {
  const nlohmann::json document = study_document(study);
  const std::string table = study_table(study);
  std::vector<std::string> files;
  const auto put = [&](const std::string& name, const std::string& text) {
    files.push_back((std::filesystem::path(folder) / name).string());
    write_text_atomic(files.back(), text);
  };
  if (report.empty()) put("study.json", document.dump(1) + "\n");
  put("table.md", table);
  put("report.html", study_html(study));
  if (common.wants_text()) {
    print_result(table);
    for (const std::string& file : files) print_result(file + "\n");
  }
  write_json(common.json, document);
}

ExitCode StudyCommand::run(const CommonOptions& common) {
  if (report.empty() == scene.empty())
    throw UsageError("study takes a SCENE, or --report with an earlier study.json");
  bool stopped = false;
  Study study;
  if (!report.empty()) {
    const auto document = nlohmann::json::parse(read_text(report), nullptr, false);
    if (document.is_discarded()) throw InputError(report + ": not valid JSON");
    study = read_study(document, report);
    if (folder.empty()) folder = std::filesystem::path(report).parent_path().string();
    if (folder.empty()) folder = ".";
    make_folder();
  } else {
    study = measure(stopped);
  }
  write(study, common);
  if (stopped) log_warn("stopped early; what was measured is written");
  if (stopped) return ExitCode::stopped;
  return conclusive(study) ? ExitCode::done : ExitCode::gate_failed;
}

/// What is measured, and how far.
void declare_race(CLI::App& app, StudyCommand& c) {
  app.add_option("SCENE", c.scene, "scene file, model, or the name of a shipped scene");
  declare_overrides(app, c.overrides);
  app.add_option("--target", c.target, "error to reach: square root of relMSE (default 1%)")
      ->type_name("FRACTION");
  app.add_option("--budget", c.budget, "time for all of it (default 10m)")->type_name("DURATION");
  app.add_option("--integrators", c.methods,
                 "all (default: every method but `reference`), or some by comma")
      ->type_name("all|LIST");
  app.add_option("--precision", c.precisions,
                 "all (default), or some of strict, mad, fast, compact by comma; the two quickest "
                 "methods are tried in each")
      ->type_name("all|LIST");
  app.add_option("--ref", c.reference,
                 "EXR to measure against, best with its variance (default: made here by "
                 "methods that see all; if two are needed, they must agree)")
      ->type_name("FILE");
  app.add_option("--seed", c.seed, "random seed of the study (default 0)")
      ->check(CLI::Range(0u, 1000000u));
  app.add_option("--memory", c.memory, "most bytes on the device, e.g. 2G")->type_name("BYTES");
  app.add_option("--kernel-dir", c.kernel_dir, "read kernels from this folder")->type_name("DIR");
}

/// What all methods are given alike, as `render` has it.
void declare_settings(CLI::App& app, StudyCommand& c) {
  app.add_option("--size", c.size, "pixels (default: the scene's shape, in 96 x 96 pixels at most)")
      ->type_name("WxH");
  app.add_option("--crop", c.crop, "x0,x1,y0,y1: a part of the picture, half-open")
      ->type_name("X0,X1,Y0,Y1");
  app.add_option("--max-depth", c.max_depth, "most segments of a path (default: the scene's)")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{0xfffffffe}));
  app.add_option("--mis", c.mis, "how strategies are weighed (default balance)")
      ->check(CLI::IsMember({"balance", "power"}))
      ->type_name("balance|power");
  app.add_option("--sampler", c.sampler, "sobol (default) or random")
      ->check(CLI::IsMember(sampler_names()))
      ->type_name("sobol|random");
  app.add_option("--light-paths", c.light_paths,
                 "light paths of an iteration (default: one per pixel)")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{0xfffffffe}));
  app.add_option("--radius", c.radius,
                 "of merging in the first pass, world units (default: by the scene); the best "
                 "method that merges is also tried with half and twice of it")
      ->type_name("LENGTH");
  app.add_option("--radius-alpha", c.radius_alpha, "how it shrinks (default 0.75)")
      ->type_name("NUMBER");
}

}  // namespace

CommandRun setup_study(CLI::App& app) {
  auto c = std::make_shared<StudyCommand>();
  CLI::Option* report =
      app.add_option("--report", c->report, "make table and report anew from this study.json")
          ->type_name("FILE");
  const std::size_t before = app.get_options().size();
  declare_race(app, *c);
  declare_settings(app, *c);
  const std::vector<CLI::Option*> all = app.get_options();
  for (std::size_t i = before; i < all.size(); ++i) report->excludes(all[i]);
  app.add_option("--out", c->folder,
                 "folder for study.json, table.md and report.html (default: here; with --report "
                 "that of its file)")
      ->type_name("DIR");
  c->device.declare(app);
  c->device.declare_threads(app);
  app.footer(
      "Exit code: 0 an option is recommended, 1 inconclusive, 75 stopped early (what was measured "
      "is written).\n\n"
      "Example: pellucid study cornell-box --target 2% --budget 5m --out cornell");
  return [c](const CommonOptions& common) { return c->run(common); };
}

}  // namespace pellucid

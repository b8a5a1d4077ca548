// bench: speed on this device, in figures that can be compared from run to run and device to
// device.
#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>

#include <nlohmann/json.hpp>

#include "apps/bench_report.h"
#include "apps/command.h"
#include "apps/common.h"
#include "apps/device_input.h"
#include "apps/scene_input.h"
#include "base/files.h"
#include "base/log.h"
#include "base/text.h"
#include "bench/method_bench.h"
#include "bench/ray_bench.h"
#include "bench/sampler_bench.h"
#include "bench/sort_bench.h"
#include "integrators/reach.h"
#include "integrators/registry.h"

namespace pellucid {
namespace {

struct BenchCommand {
  std::string only = "rays", baseline, fail_slower = "10%", kernel_dir;
  std::vector<std::string> scenes_asked;
  DeviceFlags device;
  int repeats = 7;

  ExitCode run(const CommonOptions& common) const;

 private:
  ExitCode run_rays(const CommonOptions& common) const;
  ExitCode run_sampler(const CommonOptions& common) const;
  ExitCode run_methods(const CommonOptions& common) const;
  ExitCode run_sorts(const CommonOptions& common) const;
};

/// Cells slower than in the baseline by more than `allowed` (a fraction), or absent there; empty:
/// the gate holds.
std::vector<std::string> slower_cells(const nlohmann::json& now, const nlohmann::json& before,
                                      double allowed) {
  std::vector<std::string> slower;
  std::size_t compared = 0;
  for (const auto& old_cell : before.at("rays"))
    for (const auto& cell : now.at("rays")) {
      if (cell["triangles"] != old_cell.at("triangles") || cell["kind"] != old_cell.at("kind"))
        continue;
      ++compared;
      const double ratio =
          cell["mrays_per_s"].get<double>() / old_cell.at("mrays_per_s").get<double>();
      if (ratio < 1.0 - allowed)
        slower.push_back(fmt::format("{} rays on {} triangles: {:.1f} % slower",
                                     cell["kind"].get<std::string>(), cell["triangles"].get<int>(),
                                     100 * (1 - ratio)));
    }
  if (compared != now.at("rays").size())
    slower.push_back(fmt::format("{} of {} cells cannot be compared: it lacks them",
                                 now.at("rays").size() - compared, now.at("rays").size()));
  return slower;
}

/// A baseline that a result can be compared with; checked before the bench takes its minutes.
nlohmann::json read_baseline(const std::string& file) {
  const auto document = nlohmann::json::parse(read_text(file), nullptr, false);
  const auto fail = [&](const std::string& why) {
    throw InputError(
        fmt::format("{}: {}; make it with 'pellucid bench --json {}'", file, why, file));
  };
  if (document.is_discarded()) fail("not valid JSON");
  if (!document.is_object() || !document.contains("rays") || !document["rays"].is_array() ||
      document["rays"].empty())
    fail("there is no list \"rays\"");
  for (const nlohmann::json& cell : document["rays"]) {
    const bool whole = cell.is_object() && cell.value("triangles", nlohmann::json()).is_number() &&
                       cell.value("kind", nlohmann::json()).is_string() &&
                       cell.value("mrays_per_s", nlohmann::json()).is_number();
    if (!whole) fail("an entry of \"rays\" lacks \"triangles\", \"kind\" or \"mrays_per_s\"");
    if (!(cell["mrays_per_s"].get<double>() > 0)) fail("\"mrays_per_s\" is not above 0");
  }
  return document;
}

std::vector<Scene> open_scenes(const std::vector<std::string>& names) {
  std::vector<Scene> scenes;
  for (const std::string& name : names) scenes.push_back(open_scene(name));
  return scenes;
}

ExitCode BenchCommand::run_rays(const CommonOptions& common) const {
  const double allowed = parse_fraction("--fail-slower", fail_slower);
  if (allowed < 0 || allowed >= 1)
    throw UsageError("--fail-slower takes a share from 0% to below 100%, not '" + fail_slower +
                     "'");
  const nlohmann::json before = baseline.empty() ? nlohmann::json() : read_baseline(baseline);
  const Device target = device.open();
  const std::vector<Scene> scenes = open_scenes({"rays-1k", "rays-100k", "rays-1m"});
  Progress progress("bench");
  RayBenchOptions options;
  options.repeats = repeats;
  options.plan.kernel_dir = kernel_dir;
  options.progress = [&](const std::string& text) { progress.update(text); };
  const nlohmann::json document = rays_document(bench_rays(target, scenes, options), target.info());
  if (common.wants_text()) print_result(rays_text(document));
  write_json(common.json, document);
  if (before.is_null()) return ExitCode::done;
  const std::vector<std::string> slower = slower_cells(document, before, allowed);
  for (const std::string& cell : slower) log_error("beside {}: {}", baseline, cell);
  return slower.empty() ? ExitCode::done : ExitCode::gate_failed;
}

ExitCode BenchCommand::run_sampler(const CommonOptions& common) const {
  std::vector<std::string> names{"cornell-box", "four-balls-point", "four-balls-background",
                                 "veach-mis"};
  if (!scenes_asked.empty()) names = scenes_asked;
  std::vector<Scene> scenes = open_scenes(names);
  const Device target = device.open();
  Progress progress("bench");
  SamplerBenchOptions options;
  options.repeats = repeats;
  options.plan.kernel_dir = kernel_dir;
  options.progress = [&](const std::string& text) { progress.update(text); };
  const nlohmann::json document = sampler_document(
      bench_samplers(target, std::move(scenes), find_integrator("path"), options), target.info());
  if (common.wants_text()) print_result(sampler_text(document));
  write_json(common.json, document);
  return ExitCode::done;
}

/// `bdpt`, or where it is blind to something or finds it by chance alone, `vcm`.
static const Integrator& referee_of(const PackedScene& scene, std::optional<unsigned> max_depth) {
  const Integrator& bdpt = find_integrator("bdpt");
  const SceneOptics optics = optics_of(scene, max_depth);
  const bool aims_at_all =
      unreachable_paths(bdpt, optics).empty() && chance_paths(bdpt, optics).empty();
  return aims_at_all ? bdpt : find_integrator("vcm");
}

ExitCode BenchCommand::run_methods(const CommonOptions& common) const {
  std::vector<std::string> names{"cornell-box",
                                 "four-balls-ceiling",
                                 "four-balls-sun",
                                 "four-balls-point",
                                 "four-balls-background",
                                 "veach-mis",
                                 "glass-caustic",
                                 "hidden-light-room",
                                 "keyhole",
                                 "mixed-room",
                                 "glass-lamp",
                                 "pool",
                                 "mirror-caustic"};
  if (!scenes_asked.empty()) names = scenes_asked;
  std::vector<Scene> scenes = open_scenes(names);
  std::vector<const Integrator*> methods{&find_integrator("path")};  // what gains are over
  for (const Integrator& method : integrators())
    if (&method != methods.front() && method.name != "reference")  // slow by design
      methods.push_back(&method);
  const Device target = device.open();
  Progress progress("bench");
  MethodBenchOptions options;
  options.repeats = repeats;
  options.plan.kernel_dir = kernel_dir;
  options.progress = [&](const std::string& text) { progress.update(text); };
  const nlohmann::json document = methods_document(
      bench_methods(target, std::move(scenes), methods, referee_of, options), target.info());
  if (common.wants_text()) print_result(methods_text(document));
  write_json(common.json, document);
  return ExitCode::done;
}

ExitCode BenchCommand::run_sorts(const CommonOptions& common) const {
  const Device target = device.open();
  Progress progress("bench");
  SortBenchOptions options;
  options.repeats = repeats;
  options.plan.kernel_dir = kernel_dir;
  options.progress = [&](const std::string& text) { progress.update(text); };
  const nlohmann::json document = sorts_document(bench_sorts(target, options), target.info());
  if (common.wants_text()) print_result(sorts_text(document));
  write_json(common.json, document);
  return ExitCode::done;
}

ExitCode BenchCommand::run(const CommonOptions& common) const {
  const std::vector<std::string> workloads{"rays", "render", "sampler", "sort"};
  if (std::find(workloads.begin(), workloads.end(), only) == workloads.end())
    throw UsageError("--only: there is no workload '" + only + "'; there are " + join(workloads) +
                     "." + did_you_mean(only, workloads));
  if (!scenes_asked.empty() && only == "rays")
    throw UsageError("--scene is for --only render and --only sampler");
  if (!baseline.empty() && only != "rays") throw UsageError("--baseline is for --only rays");
  if (only == "rays") return run_rays(common);
  if (only == "sort") return run_sorts(common);
  return only == "render" ? run_methods(common) : run_sampler(common);
}

}  // namespace

CommandRun setup_bench(CLI::App& app) {
  auto c = std::make_shared<BenchCommand>();
  app.add_option("--only", c->only,
                 "which workload: rays (default); render: every method on every kind of scene; "
                 "sampler: what Sobol points are worth; sort: the photon grid beside sorts by the "
                 "host")
      ->type_name("rays|render|sampler|sort");
  app.add_option("--scene", c->scenes_asked,
                 "with --only render or sampler: this scene instead of the workload's; repeatable")
      ->type_name("SCENE")
      ->allow_extra_args(false);
  c->device.declare(app);
  c->device.declare_threads(app);
  app.add_option("--repeats", c->repeats,
                 "runs of each cell; for render and sampler, seeds (default 7)")
      ->check(CLI::Range(1, 1000));
  app.add_option("--kernel-dir", c->kernel_dir, "read kernels from this folder")->type_name("DIR");
  app.add_option("--baseline", c->baseline, "an earlier --json result to compare with")
      ->type_name("FILE");
  app.add_option("--fail-slower", c->fail_slower,
                 "exit 1 if a cell is slower than the baseline by more (default 10%)")
      ->type_name("FRACTION");
  app.footer("Example: pellucid bench --only rays --json rays.json");
  return [c](const CommonOptions& common) { return c->run(common); };
}

}  // namespace pellucid

// bench: speed on this device, in figures that can be compared from run to run and device to
// device.
#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>

#include <nlohmann/json.hpp>

#include "apps/bench_gate.h"
#include "apps/bench_render.h"
#include "apps/bench_report.h"
#include "apps/bench_robustness.h"
#include "apps/bench_stability.h"
#include "apps/command.h"
#include "apps/common.h"
#include "apps/device_input.h"
#include "apps/scene_input.h"
#include "base/log.h"
#include "base/text.h"
#include "bench/ray_bench.h"
#include "bench/robust_bench.h"
#include "bench/sampler_bench.h"
#include "bench/sort_bench.h"
#include "integrators/registry.h"
#include "stability/robustness.h"

namespace pellucid {
namespace {

struct BenchCommand {
  std::string only = "rays", baseline, fail_slower = "10%", kernel_dir;
  std::vector<std::string> scenes_asked, cases_asked;
  DeviceFlags device;
  std::optional<int> repeats;  ///< absent: as the workload likes

  ExitCode run(const CommonOptions& common) const;

 private:
  ExitCode run_rays(const CommonOptions& common) const;
  ExitCode run_sampler(const CommonOptions& common) const;
  ExitCode run_renders(const CommonOptions& common) const;
  ExitCode run_sorts(const CommonOptions& common) const;
  ExitCode run_hard_cases(const CommonOptions& common) const;
  ExitCode run_robustness(const CommonOptions& common) const;
  /// What all benchmarks that take turns are told.
  template <typename Options>
  Options options_with(Progress& progress) const {
    Options options;
    options.repeats = repeats.value_or(options.repeats);
    options.plan.kernel_dir = kernel_dir;
    options.progress = [&](const std::string& text) { progress.update(text); };
    return options;
  }
  ExitCode judge(const std::vector<std::string>& worse) const;
};

std::vector<Scene> open_scenes(const std::vector<std::string>& names) {
  std::vector<Scene> scenes;
  for (const std::string& name : names) scenes.push_back(open_scene(name));
  return scenes;
}

/// What the gate says.
ExitCode BenchCommand::judge(const std::vector<std::string>& worse) const {
  for (const std::string& what : worse) log_error("beside {}: {}", baseline, what);
  return worse.empty() ? ExitCode::done : ExitCode::gate_failed;
}

ExitCode BenchCommand::run_rays(const CommonOptions& common) const {
  const double allowed = parse_allowed(fail_slower);
  const nlohmann::json before = baseline.empty() ? nlohmann::json() : read_rays_baseline(baseline);
  const Device target = device.open();
  const std::vector<Scene> scenes = open_scenes({"rays-1k", "rays-100k", "rays-1m"});
  Progress progress("bench");
  const auto options = options_with<RayBenchOptions>(progress);
  const nlohmann::json document = rays_document(bench_rays(target, scenes, options), target.info());
  if (common.wants_text()) print_result(rays_text(document));
  write_json(common.json, document);
  return before.is_null() ? ExitCode::done : judge(worse_rays(document, before, allowed));
}

ExitCode BenchCommand::run_renders(const CommonOptions& common) const {
  const double allowed = parse_allowed(fail_slower);
  const RenderBench bench(scenes_asked, repeats, kernel_dir);
  const nlohmann::json before =
      baseline.empty() ? nlohmann::json() : read_render_baseline(baseline, bench.scenes());
  const nlohmann::json document = bench.run(device);
  if (common.wants_text()) print_result(renders_text(document));
  write_json(common.json, document);
  return before.is_null() ? ExitCode::done : judge(worse_renders(document, before, allowed));
}

ExitCode BenchCommand::run_sampler(const CommonOptions& common) const {
  std::vector<std::string> names{"cornell-box", "four-balls-point", "four-balls-background",
                                 "veach-mis"};
  if (!scenes_asked.empty()) names = scenes_asked;
  std::vector<Scene> scenes = open_scenes(names);
  const Device target = device.open();
  Progress progress("bench");
  const auto options = options_with<SamplerBenchOptions>(progress);
  const nlohmann::json document = sampler_document(
      bench_samplers(target, std::move(scenes), find_integrator("path"), options), target.info());
  if (common.wants_text()) print_result(sampler_text(document));
  write_json(common.json, document);
  return ExitCode::done;
}

ExitCode BenchCommand::run_sorts(const CommonOptions& common) const {
  const Device target = device.open();
  Progress progress("bench");
  const auto options = options_with<SortBenchOptions>(progress);
  const nlohmann::json document = sorts_document(bench_sorts(target, options), target.info());
  if (common.wants_text()) print_result(sorts_text(document));
  write_json(common.json, document);
  return ExitCode::done;
}

ExitCode BenchCommand::run_hard_cases(const CommonOptions& common) const {
  const std::vector<const stability::Case*> cases = choose_cases(cases_asked);
  const stability::Lab lab{device.open(), kernel_dir, double(repeats.value_or(1)),
                           [](const std::string& name) { return open_scene(name); }};
  const nlohmann::json document = run_stability(cases, lab);
  if (common.wants_text()) print_result(stability_text(document));
  write_json(common.json, document);
  for (const nlohmann::json& one : document["cases"])
    if (one["verdict"] == "fail") return ExitCode::gate_failed;
  return ExitCode::done;
}

ExitCode BenchCommand::run_robustness(const CommonOptions& common) const {
  const Device target = device.open();
  const std::vector<Scene> scenes = open_scenes({"rays-1k", "rays-100k", "rays-1m"});
  Progress progress("bench");
  const auto options = options_with<RobustBenchOptions>(progress);
  const std::vector<PriceCell> cells =
      bench_robustness(target, scenes, find_integrator("path"), options);
  std::vector<stability::Faults> faults;
  const stability::Lab lab{target, kernel_dir};
  options.progress("faults");
  compare_leaks(lab, faults);
  compare_rehits(lab, faults);
  const nlohmann::json document = robustness_document(cells, faults, target.info());
  if (common.wants_text()) print_result(robustness_text(document));
  write_json(common.json, document);
  return ExitCode::done;
}

ExitCode BenchCommand::run(const CommonOptions& common) const {
  const std::vector<std::string> workloads{"rays", "render",    "sampler",
                                           "sort", "stability", "robustness"};
  if (std::find(workloads.begin(), workloads.end(), only) == workloads.end())
    throw UsageError("--only: there is no workload '" + only + "'; there are " + join(workloads) +
                     "." + did_you_mean(only, workloads));
  if (!scenes_asked.empty() && only != "render" && only != "sampler")
    throw UsageError("--scene is for --only render and --only sampler");
  if (!cases_asked.empty() && only != "stability")
    throw UsageError("--case is for --only stability");
  if (!baseline.empty() && only != "rays" && only != "render")
    throw UsageError("--baseline is for --only rays and --only render");
  if (only == "rays") return run_rays(common);
  if (only == "sort") return run_sorts(common);
  if (only == "stability") return run_hard_cases(common);
  if (only == "robustness") return run_robustness(common);
  return only == "render" ? run_renders(common) : run_sampler(common);
}

}  // namespace

CommandRun setup_bench(CLI::App& app) {
  auto c = std::make_shared<BenchCommand>();
  app.add_option(
         "--only", c->only,
         "which workload: rays (default); render: every method on "
         "scenes of every hard kind; "
         "sampler: what Sobol points are worth; sort: the photon grid beside sorts by the "
         "host; stability: hard cases, each held to its bound; robustness: rays beside naive ones, "
         "in time and in faults")
      ->type_name("rays|render|sampler|sort|stability|robustness");
  app.add_option("--scene", c->scenes_asked,
                 "with --only render or sampler: this scene instead of the workload's; repeatable")
      ->type_name("SCENE")
      ->allow_extra_args(false);
  app.add_option("--case", c->cases_asked,
                 "with --only stability: this case alone, by name or number; repeatable")
      ->type_name("NAME")
      ->allow_extra_args(false);
  c->device.declare(app);
  c->device.declare_threads(app);
  app.add_option("--repeats", c->repeats,
                 "runs of each cell; for render and sampler, seeds (default 7; of render 5, of "
                 "robustness 15); for stability, as many times the rays and samples (default 1)")
      ->check(CLI::Range(1, 1000));
  app.add_option("--kernel-dir", c->kernel_dir, "read kernels from this folder")->type_name("DIR");
  app.add_option("--baseline", c->baseline, "an earlier --json result to compare with")
      ->type_name("FILE");
  app.add_option(
         "--fail-slower", c->fail_slower,
         "exit 1 if anything is slower than the baseline by more (default 10%); with --only "
         "render also if an error grew beyond chance")
      ->type_name("FRACTION");
  app.footer(render_bench_help() + "\n\n" + stability_help() +
             "\n\nExample: pellucid bench --only rays --json rays.json");
  return [c](const CommonOptions& common) { return c->run(common); };
}

}  // namespace pellucid

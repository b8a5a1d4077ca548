// bench: speed on this device, in figures that can be compared from run to run and device to
// device.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/common.h"
#include "apps/device_input.h"
#include "apps/scene_input.h"
#include "base/files.h"
#include "base/log.h"
#include "base/text.h"
#include "bench/ray_bench.h"

namespace pellucid {
namespace {

struct BenchCommand {
  std::string only = "rays", baseline, fail_slower = "10%", kernel_dir;
  DeviceFlags device;
  int repeats = 7;

  ExitCode run(const CommonOptions& common) const;
};

nlohmann::json number(const std::optional<Figure>& f) {
  return f ? nlohmann::json(f->median) : nlohmann::json();
}

nlohmann::json as_json(const RayBench& bench, const DeviceInfo& device) {
  using nlohmann::json;
  json rays = json::array(), builds = json::array();
  for (const RayCell& c : bench.rays)
    rays.push_back({{"triangles", c.triangles},
                    {"kind", ray_kind_name(c.kind)},
                    {"mrays_per_s", c.mrays_per_s.median},
                    {"mrays_per_s_iqr", c.mrays_per_s.iqr},
                    {"embree_mrays_per_s", number(c.embree_mrays_per_s)},
                    {"ratio", number(c.ratio)},
                    {"embree_robust_mrays_per_s", number(c.embree_robust_mrays_per_s)},
                    {"ratio_robust", number(c.ratio_robust)},
                    {"differing_hits", c.differing_hits}});
  for (const BuildCell& b : bench.builds)
    builds.push_back({{"triangles", b.triangles},
                      {"seconds", b.seconds},
                      {"embree_seconds", b.embree_seconds ? json(*b.embree_seconds) : json()}});
  return {{"workload", "rays-1"},
          {"device", device.name},
          {"driver", device.platform_name + " " + device.driver},
          {"clock", bench.clock},
          {"rays", rays},
          {"build", builds}};
}

/// Geometric mean of a ratio over all cells, or 0 where there is none.
double geometric_mean(const nlohmann::json& rays, const char* key) {
  double sum = 0;
  for (const auto& cell : rays) {
    if (!cell[key].is_number()) return 0;
    sum += std::log(cell[key].get<double>());
  }
  return rays.empty() ? 0 : std::exp(sum / double(rays.size()));
}

std::string as_text(const nlohmann::json& d) {
  const auto text_of = [](const nlohmann::json& v, const char* format) {
    return v.is_number() ? fmt::format(fmt::runtime(format), v.get<double>()) : std::string("-");
  };
  std::string text =
      fmt::format("{} ({} time)\n{:>10} {:>9} {:>9} {:>9} {:>7} {:>9} {:>7} {:>9}\n",
                  d["device"].get<std::string>(), d["clock"].get<std::string>(), "triangles",
                  "kind", "Mrays/s", "Embree", "ratio", "robust", "ratio", "differing");
  for (const auto& c : d["rays"])
    text += fmt::format("{:>10} {:>9} {:>9.2f} {:>9} {:>7} {:>9} {:>7} {:>9}\n",
                        c["triangles"].get<int>(), c["kind"].get<std::string>(),
                        c["mrays_per_s"].get<double>(), text_of(c["embree_mrays_per_s"], "{:.2f}"),
                        text_of(c["ratio"], "{:.2f}"),
                        text_of(c["embree_robust_mrays_per_s"], "{:.2f}"),
                        text_of(c["ratio_robust"], "{:.2f}"), c["differing_hits"].get<int>());
  if (const double mean = geometric_mean(d["rays"], "ratio"); mean > 0)
    text += fmt::format("geometric mean: {:.3f} of Embree, {:.3f} of its robust mode\n", mean,
                        geometric_mean(d["rays"], "ratio_robust"));
  for (const auto& b : d["build"])
    text +=
        fmt::format("build {:>10} triangles: {:.3f} s, Embree {} s\n", b["triangles"].get<int>(),
                    b["seconds"].get<double>(), text_of(b["embree_seconds"], "{:.3f}"));
  return text;
}

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

ExitCode BenchCommand::run(const CommonOptions& common) const {
  if (only != "rays")
    throw UsageError("--only: there is no workload '" + only + "'; there is rays");
  device.limit();
  const double allowed = parse_fraction("--fail-slower", fail_slower);
  if (allowed < 0 || allowed >= 1)
    throw UsageError("--fail-slower takes a share from 0% to below 100%, not '" + fail_slower +
                     "'");
  const nlohmann::json before = baseline.empty() ? nlohmann::json() : read_baseline(baseline);
  const Device target = device.open();
  std::vector<Scene> scenes;
  for (const char* name : {"rays-1k", "rays-100k", "rays-1m"}) scenes.push_back(open_scene(name));
  Progress progress("bench");
  RayBenchOptions options;
  options.repeats = repeats;
  options.plan.kernel_dir = kernel_dir;
  options.progress = [&](const std::string& text) { progress.update(text); };
  const nlohmann::json document = as_json(bench_rays(target, scenes, options), target.info());
  if (common.wants_text()) print_result(as_text(document));
  write_json(common.json, document);
  if (before.is_null()) return ExitCode::done;
  const std::vector<std::string> slower = slower_cells(document, before, allowed);
  for (const std::string& cell : slower) log_error("beside {}: {}", baseline, cell);
  return slower.empty() ? ExitCode::done : ExitCode::gate_failed;
}

}  // namespace

CommandRun setup_bench(CLI::App& app) {
  auto c = std::make_shared<BenchCommand>();
  app.add_option("--only", c->only, "which workload: rays")->type_name("WORKLOAD");
  c->device.declare(app);
  c->device.declare_threads(app);
  app.add_option("--repeats", c->repeats, "runs of each cell (default 7)")
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

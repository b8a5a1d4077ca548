// Results of `bench --only render`: as a document, and from that as Markdown.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/bench_report.h"
#include "base/markdown.h"
#include "base/text.h"
#include "bench/method_bench.h"
#include "cl/device.h"

namespace pellucid {
namespace {

using nlohmann::json;
using Rows = std::vector<std::vector<std::string>>;

json cell_document(const MethodCell& c) {
  json entry{{"scene", c.scene},
             {"integrator", c.method},
             {"sees_all", c.sees_all},
             {"spp", c.spp},
             {"kernel_seconds", c.kernel_seconds}};
  if (!c.failed.empty()) {
    entry["failed"] = c.failed;
    return entry;
  }
  entry.update({{"samples_per_s", c.paths / c.seconds},
                {"samples_per_s_best", c.paths / c.seconds_least},
                {"mrays_per_s", 1e-6 * c.rays / c.seconds},
                {"seconds", c.seconds},
                {"pass_seconds", c.passes},
                {"relmse", c.relmse},
                {"relmse_error", c.relmse_error},
                {"relmse_runs", c.relmse_runs},
                {"relmse_equal_time", c.gain > 0 ? json(c.relmse_equal_time) : json()},
                {"efficiency", c.efficiency},
                {"gain", c.gain > 0 ? json(c.gain) : json()}});
  return entry;
}

/// Three digits, without an exponent where people would not write one.
std::string figure(const json& value) {
  if (!value.is_number()) return "-";
  const double v = value.get<double>();
  if (v >= 1e6) return fmt::format("{:.2g}", v);
  return v >= 100 ? fmt::format("{:.0f}", v) : fmt::format("{:.3g}", v);
}

std::string millions(const json& per_second) {
  return fmt::format("{:.3g}", 1e-6 * per_second.get<double>());
}

std::string scores_table(const json& device, std::size_t scenes) {
  Rows rows{{"score", "pictures/s", "likely", "Mpaths/s", "scenes seen", "kernel build s"}};
  for (const json& score : device.at("scores"))
    rows.push_back({score.at("name").get<std::string>(), figure(score.at("score")),
                    figure(score.at("low")) + " to " + figure(score.at("high")),
                    millions(score.at("samples_per_s")),
                    fmt::format("{} of {}", score.at("scenes").size(), scenes),
                    fmt::format("{:.1f}", score.at("kernel_seconds").get<double>())});
  return markdown_table(rows, 1);
}

/// Scenes down, methods across.
std::string gains_table(const json& cells) {
  Rows rows{{"gain at equal time"}};
  for (const json& cell : cells) {
    const std::string scene = cell.at("scene"), method = cell.at("integrator");
    if (scene == cells.front().at("scene")) rows.front().push_back(method);
    if (rows.back().front() != scene) rows.push_back({scene});
    std::string text = cell.contains("failed") ? "failed" : figure(cell.at("gain"));
    if (!cell.at("sees_all").get<bool>()) text = "(" + text + ")";
    rows.back().push_back(text);
  }
  return markdown_table(rows, 1);
}

/// Those that matter.
std::string passes_text(const json& passes) {
  constexpr double least_share = 0.05;
  double sum = 0;
  for (const json& seconds : passes) sum += seconds.get<double>();
  std::vector<std::string> words;
  for (const auto& [pass, seconds] : passes.items())
    if (seconds.get<double>() >= least_share * sum)
      words.push_back(fmt::format("{} {:.3g}", pass, 1e3 * seconds.get<double>()));
  return join(words);
}

std::string cells_table(const json& cells) {
  Rows rows{{"scene", "method", "spp", "Mpaths/s", "Mrays/s", "seconds", "relMSE", "at equal time",
             "build s", "ms of passes, 5 % and more"}};
  for (const json& cell : cells) {
    std::vector<std::string> row{cell.at("scene"), cell.at("integrator"),
                                 std::to_string(cell.at("spp").get<int>())};
    if (cell.contains("failed")) {
      row.insert(row.end(), {"failed", "", "", "", ""});
    } else {
      const double relmse = cell.at("relmse"), error = cell.at("relmse_error");
      row.insert(row.end(), {millions(cell.at("samples_per_s")), figure(cell.at("mrays_per_s")),
                             fmt::format("{:.3f}", cell.at("seconds").get<double>()),
                             fmt::format("{:.3g} ± {:.0f} %", relmse, 100 * error / relmse),
                             figure(cell.at("relmse_equal_time"))});
    }
    row.push_back(fmt::format("{:.1f}", cell.at("kernel_seconds").get<double>()));
    row.push_back(cell.contains("failed") ? cell["failed"].get<std::string>()
                                          : passes_text(cell.at("pass_seconds")));
    rows.push_back(row);
  }
  return markdown_table(rows, 2);
}

std::string device_text(const json& document, const json& device) {
  const json& workload = document.at("workload");
  std::string text =
      fmt::format("### {} on {}\n\n{}", workload.get<std::string>(),
                  device.at("device").get<std::string>(), device.at("driver").get<std::string>());
  if (device.contains("failed"))
    return text + ": failed: " + device["failed"].get<std::string>() + "\n";
  text += fmt::format(", {0} time; {1}x{1} pixels, {2} seeds.\n\n",
                      device.at("clock").get<std::string>(), document.at("size").get<int>(),
                      document.at("seeds").get<int>());
  if (!device.at("scores").empty())
    text += scores_table(device, document.at("scenes").size()) +
            "\nPictures with 10 % of noise (relMSE 0.01) per second, geometric mean of the scenes "
            "of which the method sees all paths.\nKernel builds take less where the driver had "
            "them in its cache.\n\n";
  const json& cells = device.at("methods");
  text += gains_table(cells) + "\nEfficiency 1 / (relMSE x seconds) over that of `" +
          cells.front().at("integrator").get<std::string>() +
          "`; in parentheses: blind to some paths.\n\n<details><summary>all figures</summary>\n\n";
  return text + cells_table(cells) + "\n</details>\n";
}

}  // namespace

json device_document(const std::vector<MethodCell>& cells, const DeviceInfo& device, bool whole) {
  json methods = json::array(), scores = json::array();
  for (const MethodCell& cell : cells) methods.push_back(cell_document(cell));
  if (whole)
    for (const MethodScore& score : method_scores(cells))
      scores.push_back({{"name", std::string(RENDER_WORKLOAD) + "/" + score.method},
                        {"score", score.score},
                        {"low", score.low},
                        {"high", score.high},
                        {"samples_per_s", score.samples_per_s},
                        {"kernel_seconds", score.kernel_seconds},
                        {"scenes", score.scenes}});
  return {{"device", device.name},
          {"spec", device.spec()},
          {"driver", device.platform_name + " " + device.driver},
          {"clock", device.cpu ? "cpu" : "wall"},
          {"methods", methods},
          {"scores", scores}};
}

std::string renders_text(const json& document) {
  std::string text;
  for (const json& device : document.at("devices"))
    text += (text.empty() ? "" : "\n") + device_text(document, device);
  return text;
}

}  // namespace pellucid

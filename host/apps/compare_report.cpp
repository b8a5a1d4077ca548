// One line per metric; where the worst is; what several runs and the z-test say.
#include "apps/compare_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace pellucid {
namespace {

std::string place(const Tile& tile) {
  return fmt::format("x {} to {}, y {} to {}", tile.x0, tile.x1 - 1, tile.y0, tile.y1 - 1);
}

/// What belongs beside a metric.
std::string remark(const std::string& name, const Comparison& found) {
  if (found.nonfinite > 0) return "";
  if (name == "worst_tile_relmse") return "  at " + place(found.error.worst_tile);
  if (name == "firefly_index")
    return fmt::format("  (reference {:.4g})", found.error.reference_firefly_index);
  if (name == "worst_channel_energy" && found.error.channel_energy.size() > 1)
    return fmt::format("  of {:.6g}", fmt::join(found.error.channel_energy, ", "));
  if (!found.split) return "";
  const ErrorSplit &a = found.split->absolute, &r = found.split->relative;
  if (name == "variance")
    return fmt::format("  90 %: {:.4g} to {:.4g}", a.variance_low90, a.variance_high90);
  if (name == "relvariance")
    return fmt::format("  90 %: {:.4g} to {:.4g}", r.variance_low90, r.variance_high90);
  return "";
}

std::string percent(double v) {
  return fmt::format("{:.3g} %", 100 * v);
}

std::string ztest_text(const ZTest& t) {
  std::string text = fmt::format("{:<22} {}: {}\n", "ztest", verdict_name(t.verdict), t.reason);
  if (t.tiles == 0) return text;
  text += fmt::format("  {:<20} {:.3g}, threshold {:.3g}; would find {}\n", "z of the picture",
                      t.image.z, t.image.threshold, percent(t.detectable_image));
  if (t.tiles_judged > 0)
    text += fmt::format("  {:<20} {:.3g}, threshold {:.3g}, at {}; would find {}\n",
                        "z of the worst tile", t.tile.z, t.tile.threshold, place(t.tile.where),
                        percent(t.detectable_tile));
  return text + fmt::format("  {:<20} {} of {}\n", "tiles judged", t.tiles_judged, t.tiles);
}

std::string split_text(const Comparison& found) {
  constexpr std::size_t few = 5;
  constexpr double noisy = 0.1;
  const RunSplit& split = *found.split;
  std::string text =
      fmt::format("  of {} runs; the metrics above are those of the first\n", found.runs);
  if (found.nonfinite > 0) return text;
  if (found.runs < few) text += "  so few runs tell little of their spread: take five or more\n";
  text +=
      split.reference_variance
          ? "  the reference's own variance is subtracted from bias2\n"
          : "  the reference tells no variance and is taken as exact: its noise counts as bias\n";
  if (split.reference_share > noisy)
    text += fmt::format("  that is {:.2g} % of the error of one run: too noisy for relbias2\n",
                        100 * split.reference_share);
  return text;
}

nlohmann::json tile_json(const Tile& tile) {
  return {{"x0", tile.x0}, {"x1", tile.x1}, {"y0", tile.y0}, {"y1", tile.y1}};
}

nlohmann::json ztest_json(const ZTest& t) {
  nlohmann::json result = {{"verdict", verdict_name(t.verdict)}, {"reason", t.reason}};
  if (t.tiles == 0) return result;
  result.update({{"image_z", t.image.z},
                 {"image_threshold", t.image.threshold},
                 {"image_difference", t.image.difference},
                 {"image_events", t.image_events},
                 {"detectable_image", t.detectable_image},
                 {"tiles", t.tiles},
                 {"tiles_judged", t.tiles_judged}});
  if (t.tiles_judged > 0)
    result.update({{"worst_tile_z", t.tile.z},
                   {"threshold", t.tile.threshold},
                   {"worst_tile_difference", t.tile.difference},
                   {"worst_tile", tile_json(t.tile.where)},
                   {"detectable_tile", t.detectable_tile}});
  return result;
}

}  // namespace

std::string comparison_table(const Comparison& found, const std::vector<Gate>& gates) {
  std::string text = fmt::format("{:<22} {}{}\n", "nonfinite", found.nonfinite,
                                 found.nonfinite > 0 ? "  FAILS: no metric can be trusted" : "");
  for (const Metric& metric : compare_metrics()) {
    if (metric.of_runs && !found.split) continue;
    text += fmt::format("{:<22} {:.6g}", metric.name, metric.value(found));
    for (const Gate& gate : gates) {
      if (gate.metric != &metric) continue;
      text += fmt::format("  {}: {} {:g}", gate.holds(found) ? "holds" : "FAILS",
                          metric.ideal == 0 ? "<=" : "|value-1| <=", gate.limit);
    }
    text += remark(metric.name, found) + '\n';
  }
  if (found.split) text += split_text(found);
  if (found.ztest) text += ztest_text(*found.ztest);
  return text;
}

nlohmann::json comparison_json(const Comparison& found, const std::vector<Gate>& gates) {
  nlohmann::json document = {{"nonfinite", found.nonfinite},
                             {"runs", found.runs},
                             {"energy_ratio_by_channel", found.error.channel_energy},
                             {"reference_firefly_index", found.error.reference_firefly_index},
                             {"gates", nlohmann::json::array()}};
  for (const Metric& metric : compare_metrics())
    if (!metric.of_runs || found.split) document[metric.name] = metric.value(found);
  for (const Gate& gate : gates) {
    document["gates"].push_back(
        {{"metric", gate.metric->name}, {"limit", gate.limit}, {"holds", gate.holds(found)}});
  }
  if (found.nonfinite == 0) document["worst_tile"] = tile_json(found.error.worst_tile);
  if (found.split) {
    const ErrorSplit &a = found.split->absolute, &r = found.split->relative;
    document["variance_interval90"] = {a.variance_low90, a.variance_high90};
    document["relvariance_interval90"] = {r.variance_low90, r.variance_high90};
    document["reference_variance_subtracted"] = found.split->reference_variance;
    if (found.split->reference_variance)
      document["reference_noise_share"] = found.split->reference_share;
  }
  if (found.ztest) document["ztest"] = ztest_json(*found.ztest);
  return document;
}

}  // namespace pellucid

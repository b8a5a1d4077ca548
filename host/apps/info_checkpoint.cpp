// info on checkpoints.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/common.h"
#include "apps/info_parts.h"
#include "apps/render_report.h"
#include "base/text.h"
#include "render/checkpoint.h"

namespace pellucid {

ExitCode checkpoint_info(const std::string& path, const CommonOptions& common) {
  const Checkpoint c = read_checkpoint(path);
  const Film& film = c.film;
  const FilmSummary summary = summarise(film);
  const Window& w = film.window;
  const PassRange span{0, film.passes.empty() ? 0 : film.passes.ranges().back().last};
  PassSet gaps;
  for (const PassRange& gap : film.passes.missing(span)) gaps.add(gap);
  nlohmann::json counters = nlohmann::json::object();
  for (const Counter& counter : c.facts.counters) counters[counter.name] = counter.count;
  std::vector<std::string> aovs;
  for (const AovChannel& aov : c.facts.aovs) aovs.push_back(aov.name);
  const nlohmann::json document = {{"file", path},
                                   {"kind", "checkpoint"},
                                   {"width", film.width},
                                   {"height", film.height},
                                   {"crop", {w.x0, w.x0 + w.width, w.y0, w.y0 + w.height}},
                                   {"passes", film.passes.text()},
                                   {"missing", gaps.text()},
                                   {"spp", film.passes.count()},
                                   {"seconds", c.facts.seconds},
                                   {"mean", summary.mean},
                                   {"error_estimate", {{"relmse", summary.relmse}}},
                                   {"aovs", aovs},
                                   {"identity", c.facts.identity},
                                   {"counters", counters},
                                   {"depth_cut", cuts_json(c.facts.cuts)}};
  std::string text = fmt::format(
      "{}: checkpoint\n  film      {}x{}, pixels {}..{} x {}..{}\n  passes    {} ({} in all); "
      "missing up to there: {}\n  rendered  in {}, mean {:.6g}\n  counters  {}\n",
      path, film.width, film.height, w.x0, w.x0 + w.width - 1, w.y0, w.y0 + w.height - 1,
      film.passes.text(), film.passes.count(), gaps.text(), format_seconds(c.facts.seconds),
      summary.mean,
      error_count(c.facts.counters) ? describe_counters(c.facts.counters) : "no errors");
  if (const std::string cut = describe_cuts(c.facts.cuts); !cut.empty())
    text += fmt::format("  cut off   {}\n", cut);
  if (!aovs.empty()) text += fmt::format("  channels  {}\n", join(aovs));
  for (const auto& [name, value] : c.facts.identity)
    text += fmt::format("  {:<12} {}\n", name, value);
  if (common.wants_text()) print_result(text);
  write_json(common.json, document);
  return ExitCode::done;
}

}  // namespace pellucid

// table.md, its columns aligned.
#include "study/report/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/markdown.h"
#include "base/text.h"
#include "study/report/facts.h"
#include "study/report/text.h"

namespace pellucid {
namespace {

/// The farthest a rung lies from the time it is shown for: rungs double.
constexpr double NEAR_RUNG = 1.5;

using Row = std::vector<std::string>;

std::string option_table(const Study& study) {
  const std::vector<double> times = round_times(study);
  std::vector<Row> rows{{"option", "setup s"}};
  for (double t : times) rows[0].push_back(duration(t, 1));
  for (const std::string& head :
       {std::string("tiles within"), std::string("slope [90 %]"), std::string("bias <="),
        "to " + percent(study.target, 1) + " [90 %]", std::string("flags")})
    rows[0].push_back(head);
  for (std::size_t i : ranked(study)) {
    const StudyOption& option = study.options[i];
    const std::vector<std::string> flags = flags_of(study, i);
    Row row{option.name(), option.setup_seconds > 0 ? digits(option.setup_seconds) : "-"};
    for (double t : times) row.push_back(error_near(option, t));
    row.push_back(tiles_text(option));
    row.push_back(slope_text(verdict_of(study, i)));
    row.push_back(bias_text(option));
    row.push_back(target_text(study, i));
    row.push_back(join(flags.empty() ? std::vector{rank_text(study, i)} : flags, "; "));
    rows.push_back(row);
  }
  return markdown_table(rows);
}

std::string pair_table(const Study& study) {
  std::vector<Row> rows{{"precision", "bias", "bias <=", "divergent paths per million",
                         "time / strict [least, largest]", "harmless until t*"}};
  for (const PrecisionPair& pair : study.pairs) {
    const std::optional<FloorTime> floor = floor_time(study, pair);
    rows.push_back({pair.integrator + " " + pair.precision, pair_bias_text(pair),
                    pair.bias2_upper90 > 0 ? percent(std::sqrt(pair.bias2_upper90)) : "-",
                    digits(pair.divergent_per_million, 3),
                    fmt::format("{} [{}, {}]", digits(pair.time_ratio, 3), digits(pair.time_low, 3),
                                digits(pair.time_high, 3)),
                    floor ? (floor->at_least ? ">= " : "") + duration(floor->seconds) : "-"});
  }
  return markdown_table(rows);
}

std::string bullets(const std::string& title, const std::vector<std::string>& items) {
  if (items.empty()) return "";
  std::string text = "\n" + title + "\n\n";
  for (const std::string& item : items) text += "- " + markdown_line(item) + "\n";
  return text;
}

}  // namespace

std::vector<double> round_times(const Study& study) {
  static const double round[] = {0.01, 0.03, 0.1,  0.3,  1,     3,     10,    30,    60,
                                 180,  600,  1800, 3600, 10800, 36000, 86400, 259200};
  double longest = 0;
  for (const StudyOption& option : study.options) longest = std::max(longest, longest_run(option));
  std::vector<double> times;
  for (auto t = std::rbegin(round); t != std::rend(round) && times.size() < 3; ++t) {
    if (*t > NEAR_RUNG * longest || (!times.empty() && *t > times.back() / 5)) continue;
    if (std::any_of(study.options.begin(), study.options.end(),
                    [&](const StudyOption& option) { return error_near(option, *t) != "-"; }))
      times.push_back(*t);
  }
  std::reverse(times.begin(), times.end());
  return times;
}

std::string error_near(const StudyOption& option, double seconds) {
  const ErrorPoint* nearest = nullptr;
  double distance = std::log(NEAR_RUNG);
  const std::vector<ErrorPoint> curve = error_curve(option);
  for (const ErrorPoint& point : curve) {
    const double d = std::abs(std::log(point.seconds / seconds));
    if (point.seconds > 0 && d <= distance) nearest = &point, distance = d;
  }
  if (!nearest || (!nearest->error && !nearest->high)) return "-";
  std::string text = nearest->error ? percent(*nearest->error) : "<= " + percent(*nearest->high);
  if (distance > std::log(1.1)) text += " (" + duration(nearest->seconds) + ")";
  return text;
}

std::string study_table(const Study& study) {
  std::string text = "# What accuracy costs: " + markdown_line(study.scene) + "\n\n";
  text += study.recommendation.empty() ? "No recommendation." : markdown_line(study.recommendation);
  text += "\n\n" + markdown_line(settings_line(study)) + ".\n";
  if (!study.complete) text += "\nStopped early: what follows rests on the runs made until then.\n";
  text += bullets("Warnings:", study.warnings);
  if (!study.options.empty()) {
    text += "\n" + option_table(study);
    text +=
        "\nErrors are sqrt(relMSE), mean of the runs, at the rung nearest to the time (the rung's "
        "own in brackets\nif off by more than a tenth); tiles within: share of tiles of 8x8 pixels "
        "whose error is within the target at the last\nrung; bias <= and slope at 90 % "
        "confidence.\n";
  }
  if (!study.pairs.empty())
    text +=
        "\n" + pair_table(study) +
        "\nPrecisions are compared with strict arithmetic by the same seeds; t* is where strict "
        "noise meets the bias.\n";
  text += bullets("Reference:", reference_lines(study.reference));
  text += "\nMachine: " + markdown_line(machine_line(study.machine)) + ".\n";
  text += bullets("What would change this verdict:", study.would_change);
  return text;
}

}  // namespace pellucid

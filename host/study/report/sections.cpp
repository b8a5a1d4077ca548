// Tables, pictures and raw figures of the page.
#include "study/report/sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/text.h"
#include "study/report/facts.h"
#include "study/report/markup.h"
#include "study/report/style.h"
#include "study/report/table.h"
#include "study/report/text.h"

namespace pellucid {
namespace {

/// The option's name with its colour.
std::string name_cell(const StudyOption& option) {
  return "<span class=\"w\"><span class=\"chip " + option_classes(option) + "\"></span>" +
         escaped(option.name()) + "</span>";
}

std::string root_percent(double relmse) {
  return relmse > 0 ? percent(std::sqrt(relmse)) : "-";
}

std::string energy_text(const Verdict& v) {
  if (v.energy_low == v.energy_high) return "-";  // was not estimated
  return fmt::format("{} [{}, {}]", digits(v.energy, 4), digits(v.energy_low, 4),
                     digits(v.energy_high, 4));
}

/// "" unless it could be base64 of something.
std::string image(const std::string& base64, const std::string& what) {
  const bool sound = std::all_of(base64.begin(), base64.end(), [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '+' ||
           c == '/' || c == '=';
  });
  if (base64.empty() || !sound) return "";
  return element("img",
                 fmt::format("src=\"data:image/png;base64,{}\" alt=\"{}\"", base64, escaped(what)));
}

/// The run that was pictured: the first one, at its last rung.
std::string pictured(const StudyOption& option) {
  if (option.runs.empty() || option.runs[0].rungs.empty()) return "";
  const Rung& rung = option.runs[0].rungs.back();
  return fmt::format(": {} spp, {}, error {}", rung.spp, duration(rung.seconds),
                     root_percent(rung.relmse));
}

std::string figure(const std::string& images, const std::string& name, const std::string& more) {
  return element(
      "figure", "",
      images + element("figcaption", "", "<b>" + escaped(name) + "</b>" + escaped(more)));
}

std::string run_table(const StudyOption& option) {
  HtmlTable table;
  table.head = {"seed", "spp", "seconds", "on the wall", "relMSE", "error", "energy / reference"};
  table.classes = {"n", "n", "n", "n", "n", "n", "n"};
  for (const StudyRun& run : option.runs)
    for (const Rung& r : run.rungs)
      table.rows.push_back({std::to_string(run.seed), std::to_string(r.spp), digits(r.seconds, 5),
                            digits(r.wall_seconds, 5), digits(r.relmse, 5),
                            r.relmse > 0 ? percent(std::sqrt(r.relmse), 3) : "-",
                            digits(r.energy_ratio, 6)});
  return table.html();
}

}  // namespace

std::string option_section(const Study& study) {
  if (study.options.empty()) return "";
  const std::vector<double> times = round_times(study);
  HtmlTable table;
  table.head = {"option", "to " + percent(study.target, 1) + " [90 %]", "set-up"};
  table.classes = {"", "time", "n"};
  for (double t : times)
    table.head.push_back("error at " + duration(t, 1)), table.classes.push_back("n");
  for (const char* head : {"tiles within", "slope [90 %]", "bias \u2264", "energy [90 %]"})
    table.head.push_back(head), table.classes.push_back("n");
  table.head.push_back("flags");
  table.classes.push_back("flags");
  for (std::size_t i : ranked(study)) {
    const StudyOption& option = study.options[i];
    const Verdict verdict = verdict_of(study, i);
    std::vector<std::string> row{name_cell(option), target_text(study, i),
                                 option.setup_seconds > 0 ? duration(option.setup_seconds) : "-"};
    for (double t : times) row.push_back(error_near(option, t));
    row.push_back(tiles_text(option));
    row.push_back(slope_text(verdict));
    row.push_back(bias_text(option));
    row.push_back(option.runs.empty() ? "-" : energy_text(verdict));
    for (std::size_t c = 1; c < row.size(); ++c) row[c] = escaped(row[c]);
    const std::string flags = join(flags_of(study, i), "; ");
    row.push_back(flags.empty() ? escaped(rank_text(study, i))
                                : text_element("span", "class=\"alarm\"", flags));
    table.rows.push_back(row);
    table.row_classes.push_back(int(i) == study.recommended         ? "best"
                                : option.state == OptionState::main ? ""
                                                                    : "grey");
  }
  return table.html();
}

std::string precision_section(const Study& study) {
  if (study.pairs.empty()) return "";
  HtmlTable table;
  table.head = {
      "option",        "bias",           "bias \u2264",       "divergent paths per million",
      "time / strict", "least, largest", "harmless until t*", "spp"};
  table.classes = {"", "n", "n", "n", "n", "n", "n", "n"};
  for (const PrecisionPair& pair : study.pairs) {
    const std::optional<FloorTime> floor = floor_time(study, pair);
    StudyOption option;
    option.integrator = pair.integrator, option.precision = pair.precision;
    table.rows.push_back(
        {name_cell(option), pair_bias_text(pair), root_percent(pair.bias2_upper90),
         digits(pair.divergent_per_million, 3), digits(pair.time_ratio, 3),
         digits(pair.time_low, 3) + ", " + digits(pair.time_high, 3),
         floor ? (floor->at_least ? "\u2265 " : "") + duration(floor->seconds) : "-",
         std::to_string(pair.spp)});
  }
  return table.html();
}

std::string picture_section(const Study& study) {
  std::string figures;
  const std::string reference = image(study.reference.picture, "reference");
  if (!reference.empty())
    figures += figure(reference, "reference",
                      study.reference.source.empty() ? "" : ": " + study.reference.source);
  for (std::size_t i : ranked(study)) {
    const StudyOption& option = study.options[i];
    const std::string images = image(option.picture, option.name()) +
                               image(option.error_map, "error map of " + option.name());
    if (!images.empty()) figures += figure(images, option.name(), pictured(option));
  }
  return figures.empty() ? "" : element("div", "class=\"pictures\"", figures);
}

std::string reachability_section(const Study& study) {
  HtmlTable table;
  table.head = {"method", "never sees", "finds by chance alone"};
  std::set<std::string> told;
  for (const StudyOption& option : study.options) {
    if (!told.insert(option.integrator).second) continue;
    const auto words = [](const std::vector<std::string>& classes) {
      return classes.empty() ? "nothing" : escaped(join(classes, "; "));
    };
    const std::string chip = "<span class=\"chip " + method_class(option.integrator) + "\"></span>";
    table.rows.push_back({"<span class=\"w\">" + chip + escaped(option.integrator) + "</span>",
                          option.unreachable.empty()
                              ? words(option.unreachable)
                              : "<span class=\"alarm\">" + words(option.unreachable) + "</span>",
                          words(option.chance)});
  }
  return table.rows.empty() ? "" : table.html();
}

std::string run_section(const Study& study) {
  std::string text;
  for (const StudyOption& option : study.options) {
    if (option.runs.empty()) continue;
    const std::string title = fmt::format("{}: {} run{}", option.name(), option.runs.size(),
                                          option.runs.size() == 1 ? "" : "s");
    text += element("details", "", text_element("summary", "", title) + run_table(option));
  }
  return text;
}

}  // namespace pellucid

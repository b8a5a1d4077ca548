// The page of a study, from verdict to raw figures.
#include "study/report/html.h"

#include <fmt/format.h>

#include "base/text.h"
#include "study/report/charts.h"
#include "study/report/facts.h"
#include "study/report/markup.h"
#include "study/report/sections.h"
#include "study/report/style.h"
#include "study/report/text.h"

namespace pellucid {
namespace {

std::string note(const std::string& text) {
  return text_element("p", "class=\"note\"", text);
}

/// A chart as wide as the page allows.
std::string wide(const std::string& chart) {
  return chart.empty() ? "" : element("figure", "class=\"wide\"", chart);
}

/// A section that is left out where it would be empty.
std::string section(const std::string& title, const std::string& content,
                    const std::string& remark = "") {
  if (content.empty()) return "";
  return text_element("h2", "", title) + (remark.empty() ? "" : note(remark)) + content;
}

std::string headline(const Study& study) {
  std::string text = text_element("h1", "", "What accuracy costs: " + study.scene);
  text += text_element(
      "p", "class=\"verdict\"",
      study.recommendation.empty() ? std::string("No recommendation.") : study.recommendation);
  text += text_element("p", "class=\"facts\"", settings_line(study) + ".");
  std::vector<std::string> warnings = study.warnings;
  if (!study.complete)
    warnings.insert(warnings.begin(),
                    "Stopped early: what follows rests on the runs made until then.");
  if (!study.reference.trusted)
    warnings.push_back("No trusted reference" +
                       (study.reference.doubt.empty() ? "." : ": " + study.reference.doubt));
  if (!warnings.empty()) text += element("div", "class=\"box\"", html_list(warnings));
  return text;
}

/// Beside the charts: how they are to be read, and what the figures rest on.
std::string aside(const Study& study) {
  std::string text;
  const std::string changes = html_list(study.would_change);
  if (!changes.empty()) text += text_element("h3", "", "What would change this verdict") + changes;
  text += text_element("h3", "", "Reference") + html_list(reference_lines(study.reference));
  text += text_element("h3", "", "Machine") + text_element("p", "", machine_line(study.machine));
  text += text_element("h3", "", "How to read this") +
          note(
              "Error is sqrt(relMSE) of one run, the mean over runs with seeds of their own; the "
              "reference's noise is taken off. Seconds are those of rendering; set-up is apart.") +
          note(
              "Seconds to the target are measured (a rung lies there), interpolated between rungs, "
              "or extrapolated by the fit, with the factor beyond the longest run. Intervals hold "
              "at 90 % confidence. Unbiased methods have a slope of -1.");
  return element("div", "", text);
}

std::string charts(const Study& study) {
  const std::string target = target_chart(study), error = error_chart(study);
  std::string figures;
  if (!target.empty())
    figures +=
        text_element("h3", "", "Seconds to an error of " + percent(study.target, 1)) + wide(target);
  if (!error.empty())
    figures += text_element("h3", "", "Error over seconds of rendering") + wide(error);
  if (figures.empty()) figures = note("There are no runs to draw.");
  return element("div", "class=\"two\"", element("div", "", figures) + aside(study));
}

std::string counters(const Study& study) {
  HtmlTable table;
  table.head = {"option",
                "state",
                "runs",
                "wrong values",
                "memory",
                "pilot: 1 / (relMSE s)",
                "fit off by at most"};
  table.classes = {"", "", "n", "n", "n", "n", "n"};
  for (std::size_t i = 0; i < study.options.size(); ++i) {
    const StudyOption& option = study.options[i];
    const Verdict v = verdict_of(study, i);
    const std::string state = state_text(option.state);
    table.rows.push_back({escaped(option.name()), state.empty() ? "complete" : state,
                          std::to_string(option.runs.size()), std::to_string(option.wrong),
                          option.memory_bytes > 0 ? format_bytes(option.memory_bytes) : "-",
                          option.pilot_efficiency > 0 ? digits(option.pilot_efficiency, 3) : "-",
                          v.noise > 0 || v.bias > 0 ? percent(v.fit_residual) : "-"});
  }
  return table.rows.empty() ? "" : table.html();
}

std::string body(const Study& study) {
  std::string text = headline(study) + charts(study);
  text += section("Options", option_section(study),
                  "The error at a time is that of the nearest rung, whose own seconds stand in "
                  "brackets where they are off by more than a tenth.");
  text +=
      section("Variance and bias", split_charts(study),
              "Share of variance (light) and of squared bias (full) in the error, by samples per "
              "pixel, with the error below; the tick is the upper 90 % bound of the bias.");
  text += section("Which method is best where", wide(tile_chart(study)),
                  fmt::format("Tiles of {0}x{0} pixels by the least relMSE times seconds of the "
                              "longest runs; rest on a tile for its error.",
                              STUDY_TILE));
  text += section("Where the time goes", wide(pass_chart(study)),
                  "Seconds of one sample per pixel, pass by pass, the dearest first.");
  text +=
      section("Precision", precision_section(study),
              "The same seeds in relaxed and in strict arithmetic: noise cancels, bias remains. "
              "t* is where strict noise has come down to that bias.");
  text += section("Pictures", picture_section(study),
                  "One run of each option at its last rung, and below it the map of its error, the "
                  "root of each pixel's relMSE "
                  "on a logarithmic scale: 0.1 % and less black, 1 % blue, 10 % red, 100 % yellow, "
                  "1000 % white.");
  text += section("What methods cannot see", reachability_section(study));
  text += section("Counters, memory, fits", counters(study));
  text += section("Every run", run_section(study));
  return element("main", "", text);
}

}  // namespace

std::string study_html(const Study& study) {
  std::string head = element("meta", "charset=\"utf-8\"");
  // Nothing is loaded and nothing runs, and browsers are told so.
  head += element("meta",
                  "http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src "
                  "data:; style-src 'unsafe-inline'\"");
  head += element("meta", "name=\"viewport\" content=\"width=device-width, initial-scale=1\"");
  head += text_element("title", "", "What accuracy costs: " + study.scene);
  head += element("style", "", style_sheet());
  return "<!DOCTYPE html>\n" +
         element("html", "lang=\"en\"",
                 element("head", "", head) + element("body", "", body(study)));
}

}  // namespace pellucid

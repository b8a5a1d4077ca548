// The stability suite's results as a document for scripts and as a table for people.
#include "apps/bench_stability.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/log.h"
#include "base/markdown.h"
#include "base/text.h"

namespace pellucid {
namespace {

using nlohmann::json;
using stability::Case;
using stability::Check;
using stability::Result;

json document_of(const Result& result) {
  json checks = json::array();
  for (const Check& check : result.checks)
    checks.push_back({{"what", check.what},
                      {"measured", check.measured},
                      {"bound", check.bound},
                      {"holds", check.holds()}});
  const Check* worst = result.worst();
  return {{"case", result.which->name},
          {"number", result.which->number},
          {"title", result.which->title},
          {"methods", result.which->methods},
          {"naive", result.which->naive},
          {"verdict", verdict_name(result.verdict)},
          {"measured", worst ? json(worst->measured) : json()},
          {"bound", worst ? json(worst->bound) : json()},
          {"what", worst ? json(worst->what) : json()},
          {"note", result.note},
          {"seconds", result.seconds},
          {"checks", checks}};
}

std::string figure(const json& value) {
  return value.is_number() ? fmt::format("{:.3g}", value.get<double>()) : "-";
}

}  // namespace

std::vector<const Case*> choose_cases(const std::vector<std::string>& asked) {
  std::vector<std::string> names;
  for (const Case& c : stability::cases()) names.push_back(c.name);
  for (const std::string& name : asked)
    if (std::none_of(stability::cases().begin(), stability::cases().end(), [&](const Case& c) {
          return name == c.name || name == std::to_string(c.number);
        }))
      throw UsageError("--case: there is no case '" + name + "'; there are " + join(names) + "." +
                       did_you_mean(name, names));
  std::vector<const Case*> chosen;
  for (const Case& c : stability::cases())
    if (asked.empty() || std::any_of(asked.begin(), asked.end(), [&](const std::string& name) {
          return name == c.name || name == std::to_string(c.number);
        }))
      chosen.push_back(&c);
  return chosen;
}

json run_stability(const std::vector<const Case*>& cases, stability::Lab lab) {
  Progress progress("bench");
  json results = json::array();
  for (const Case* c : cases) {
    progress.update(c->name);
    lab.progress = [&](const std::string& at) { progress.update(c->name + ": " + at); };
    const Result result = run_case(*c, lab);
    log_verbose("{} {}; naive code: {}", c->number, c->name, c->naive);
    for (const Check& check : result.checks)
      log_verbose("  {}: {:.3g}, at most {:.3g}", check.what, check.measured, check.bound);
    results.push_back(document_of(result));
  }
  return {{"workload", "stability-1"},
          {"device", lab.device.info().name},
          {"driver", lab.device.info().platform_name + " " + lab.device.info().driver},
          {"effort", lab.effort},
          {"missing", stability::missing_cases()},
          {"cases", results}};
}

std::string stability_text(const json& document) {
  std::vector<std::vector<std::string>> rows{
      {"case", "methods", "verdict", "nearest to its bound", "measured", "bound", "s"}};
  std::string details;
  for (const json& c : document["cases"]) {
    const std::string name =
        fmt::format("{:>2} {}", c["number"].get<int>(), c["case"].get<std::string>());
    rows.push_back({name, c["methods"], c["verdict"], c["what"].is_string() ? c["what"] : c["note"],
                    figure(c["measured"]), figure(c["bound"]),
                    fmt::format("{:.1f}", c["seconds"].get<double>())});
    if (c["verdict"] == "fail" || c["verdict"] == "warned")
      details += name + ": " + c["title"].get<std::string>() + "\n";
    if (c["what"].is_string() && c["note"] != "")
      details += "  " + c["note"].get<std::string>() + "\n";
    for (const json& check : c["checks"])
      if (!check["holds"])
        details += fmt::format("  {}: {} instead of at most {}\n", check["what"].get<std::string>(),
                               figure(check["measured"]), figure(check["bound"]));
  }
  constexpr std::size_t first_number = 4;
  return document["device"].get<std::string>() + "\n" + markdown_table(rows, first_number) +
         details;
}

std::string stability_help() {
  std::string text =
      "--only stability measures hard cases and holds them to bounds; it ends with "
      "exit code 1 if one fails. The table has of each case what is nearest to its bound; "
      "--verbose tells all that is measured, and what naive code gives. They are:";
  for (const Case& c : stability::cases())
    text += fmt::format("\n  {:2} {}: {}", c.number, c.name, c.title);
  const std::vector<int> missing = stability::missing_cases();
  if (!missing.empty())
    text += fmt::format("\nNot in it yet, of the catalogue's 38: {}.", fmt::join(missing, ", "));
  return text;
}

}  // namespace pellucid

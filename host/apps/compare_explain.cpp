// Tables of energies and the answer in words.
#include "apps/compare_explain.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/text.h"
#include "image/image_pair.h"

namespace pellucid {
namespace {

using namespace explain;

constexpr int text_width = 96;
/// Pixels: sixteen cells that noise is told by (explain/layered.h).
constexpr int least_side = 16;

/// Words in lines of that width, each after two blanks.
std::string wrapped(const std::string& text) {
  std::string lines, line;
  for (std::size_t i = 0; i <= text.size();) {
    const std::size_t end = std::min(text.find(' ', i), text.size());
    const std::string word = text.substr(i, end - i);
    if (!line.empty() && line.size() + 1 + word.size() > text_width) {
      lines += "  " + line + '\n';
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
    i = end + 1;
  }
  return lines + "  " + line + '\n';
}

std::string table(const Explanation& x, const Rows& rows, const char* what) {
  std::string text = fmt::format("  {:<22}{:>12}{:>12}  {}/{} (R, G, B)\n", what, x.names.known,
                                 x.names.other, x.names.other, x.names.known);
  for (const Row& row : rows) {
    text += fmt::format("  {:<22}{:>12.5g}{:>12.5g} ", row.name, row.all_known() / COLOURS,
                        row.all_other() / COLOURS);
    for (std::size_t c = 0; c < COLOURS; ++c)
      text += row.known[c] > 0 ? fmt::format(" {:.4f}+-{:.4f}", row.ratio[c], row.error[c])
                               : std::string(" -");
    text += '\n';
  }
  return text;
}

nlohmann::json rows_json(const Rows& rows) {
  nlohmann::json list = nlohmann::json::array();
  for (const Row& row : rows)
    list.push_back({{"name", row.name},
                    {"known", row.known},
                    {"other", row.other},
                    {"ratio", row.ratio},
                    {"error", row.error}});
  return list;
}

std::string settings_of(const NamedImage& named) {
  const std::string integrator = text_attribute(named.image, "pellucid:integrator");
  return integrator.empty() ? ""
                            : integrator + " " + text_attribute(named.image, "pellucid:settings");
}

/// The digits after "max-depth "; "" where there are none.
std::string depth_cap_of(const std::string& settings) {
  const std::string name = "max-depth ";
  const std::size_t at = settings.find(name);
  if (at == std::string::npos) return "";
  const std::size_t first = at + name.size();
  return settings.substr(first, settings.find_first_not_of("0123456789", first) - first);
}

/// What the files themselves tell.
void add_notes_of_files(const NamedImage& a, const NamedImage& b, Explanation& x) {
  const std::string of_a = settings_of(a), of_b = settings_of(b);
  if (!of_a.empty() && !of_b.empty() && of_a != of_b)
    x.notes.push_back(fmt::format("the files tell settings that differ: A {}; B {}", of_a, of_b));
  for (const NamedImage* named : {&a, &b}) {
    const std::string cap = depth_cap_of(settings_of(*named));
    if (!cap.empty())
      x.notes.push_back(fmt::format(
          "'{}' was rendered with --max-depth {}: longer paths are not in it", named->name, cap));
  }
  for (const NamedImage* named : {&a, &b})
    if (!settings_of(*named).empty() && !pixels_are_independent(named->image)) {
      x.notes.push_back(
          "pixels of methods with light paths depend on each other, so that noise may "
          "be larger than told here: make sure by pictures of another --seed");
      break;
    }
}

}  // namespace

Explanation explain_pair(const NamedImage& a, const NamedImage& b) {
  for (const NamedImage* named : {&a, &b})
    if (colour_channels(named->image).size() != COLOURS)
      throw InputError(
          fmt::format("--explain takes pictures with R, G and B, not '{}'", named->name));
  if (a.image.width < least_side || a.image.height < least_side)
    throw InputError(
        fmt::format("--explain: '{}' has {}x{} pixels, and it takes {}x{} to tell noise "
                    "from a difference",
                    a.name, a.image.width, a.image.height, least_side, least_side));
  const Layered of_a(a.image), of_b(b.image);
  if (of_a.layers() == 0 && of_b.layers() == 0)
    throw UsageError(fmt::format(
        "--explain: neither '{}' nor '{}' has layers by path length; render one of them "
        "with '--aov length --aov-length 12 -o FILE.exr'",
        a.name, b.name));
  const bool a_adds_up = of_a.layers() > 0 && of_a.adds_up();
  const bool b_adds_up = of_b.layers() > 0 && of_b.adds_up();
  if (!a_adds_up && !b_adds_up)
    throw InputError(
        fmt::format("--explain: the layers by path length of '{}' do not add up to its "
                    "colours: it was changed after it was rendered",
                    of_a.layers() > 0 ? a.name : b.name));
  Explanation x = a_adds_up ? explain::explain(of_a, of_b, {"A", "B"}, b_adds_up)
                            : explain::explain(of_b, of_a, {"B", "A"}, false);
  for (const auto& [layered, adds_up, named] :
       {std::make_tuple(&of_a, a_adds_up, &a), std::make_tuple(&of_b, b_adds_up, &b)})
    if (layered->layers() > 0 && !adds_up)
      x.notes.push_back(
          fmt::format("the layers of '{}' do not add up to its colours, so it was "
                      "changed after it was rendered, and they are left aside",
                      named->name));
  add_notes_of_files(a, b, x);
  return x;
}

std::string explanation_text(const Explanation& x) {
  std::string text = fmt::format("explain\n{}", wrapped(x.words));
  if (!x.advice.empty()) text += wrapped("Next: " + x.advice + ".");
  text += table(x, x.lengths, x.by_regression ? "length, by regression" : "length");
  if (!x.strategies.empty()) text += table(x, x.strategies, "strategy");
  if (x.finding != Finding::none)
    text +=
        fmt::format("  {:<22}{:>12}{:>12}{:>14}\n", "cause", "explains", "leaves", "probability");
  for (const Ranked& r : x.causes)
    if (x.finding != Finding::none)
      text += fmt::format("  {:<22}{:>10.1f} %{:>12.4g}{:>14.3g}\n", r.cause.id, 100 * r.explained,
                          r.cause.misfit, r.probability);
  for (const std::string& note : x.notes) text += wrapped("Note: " + note + ".");
  return text;
}

nlohmann::json explanation_json(const Explanation& x) {
  nlohmann::json causes = nlohmann::json::array();
  for (const Ranked& r : x.causes) {
    nlohmann::json figures = nlohmann::json::object();
    for (const auto& [name, value] : r.cause.figures) figures[name] = value;
    causes.push_back({{"cause", r.cause.id},
                      {"words", r.cause.words},
                      {"figures", figures},
                      {"misfit", r.cause.misfit},
                      {"parameters", r.cause.parameters},
                      {"explained", r.explained},
                      {"probability", r.probability}});
  }
  const bool named =
      x.finding == Finding::cause || x.finding == Finding::several || x.finding == Finding::partly;
  return {{"finding", finding_name(x.finding)},
          {"cause", named ? nlohmann::json(x.causes.front().cause.id) : nlohmann::json()},
          {"words", x.words},
          {"next", x.advice},
          {"known", x.names.known},
          {"other", x.names.other},
          {"by_regression", x.by_regression},
          {"lengths", rows_json(x.lengths)},
          {"strategies", rows_json(x.strategies)},
          {"causes", causes},
          {"significance", x.significance},
          {"detectable", x.detectable},
          {"remains", x.remains},
          {"notes", x.notes}};
}

}  // namespace pellucid

// Events of a replay, joined into vertices and contributions.
#include "apps/replay_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/markdown.h"

namespace pellucid {
namespace {

using nlohmann::json;

/// Contributions that a table shows; the document has all.
constexpr std::size_t most_rows = 12;

const char* strategy_name(const PathEvent& e) {
  switch (e.kind) {
    case EVENT_EMISSION:
      return "chance";
    case EVENT_NEE:
      return "light sample";
    case EVENT_CONNECT:
      return "connection";
    case EVENT_MERGE:
      return "merge";
    default:
      return "splat";
  }
}

/// Segments of the whole path. A merge takes two ends for one point.
uint length_of(const PathEvent& e) {
  return e.kind == EVENT_MERGE ? e.s + e.t - 2 : e.s + e.t - 1;
}

/// The light path that takes part, or NONE.
uint light_path_of(const PathEvent& e) {
  return e.on_light ? e.path : e.partner;
}

std::string name_of_material(const Scene& scene, uint material) {
  return material < scene.materials.size() ? scene.materials[material].name : "-";
}

std::string three(const F4& v) {
  return fmt::format("{:.5g} {:.5g} {:.5g}", v.x, v.y, v.z);
}

json three_json(const F4& v) {
  return {v.x, v.y, v.z};
}

/// Where an event is, in coordinates of the scene's file.
std::array<double, 3> place_of(const PathEvent& e, const Replay& r) {
  return {r.origin[0] + double(e.p.x), r.origin[1] + double(e.p.y), r.origin[2] + double(e.p.z)};
}

std::string place(const PathEvent& e, const Replay& r) {
  return fmt::format("{:.7g}", fmt::join(place_of(e, r), " "));
}

/// Densities are recorded as 0 where a strategy cannot be.
std::string density(float pdf) {
  return pdf > 0 ? fmt::format("{:.4g}", pdf) : "-";
}

/// What the sample got of it.
double share_of(const PathEvent& e, const Replay& replay) {
  return double(luminance_of(e)) / double(luminance_of(replay.sum));
}

/// A vertex of a walk, and how it went on from there.
struct WalkVertex {
  const PathEvent* arrived = nullptr;
  const PathEvent* left = nullptr;
};

std::vector<WalkVertex> vertices_of(const std::vector<PathEvent>& walk) {
  std::vector<WalkVertex> vertices;
  for (const PathEvent& e : walk) {
    if (e.kind == EVENT_SCATTER) {
      if (!vertices.empty()) vertices.back().left = &e;
    } else {
      vertices.push_back({&e, e.kind == EVENT_START ? &e : nullptr});
    }
  }
  return vertices;
}

std::string walk_table(const std::vector<PathEvent>& walk, const Replay& r, const Scene& scene) {
  std::vector<std::vector<std::string>> rows{
      {"vertex", "position", "normal", "material", "beta", "onward", "pdf", "dVCM", "dVC"}};
  for (const WalkVertex& v : vertices_of(walk)) {
    const PathEvent& at = *v.arrived;
    const bool start = at.kind == EVENT_START;
    const std::string pdf = !v.left ? "ends" : v.left->d.w > 0 ? density(v.left->d.w) : "delta";
    rows.push_back(
        {std::to_string(at.depth), place(at, r), start ? "-" : three(at.d),
         start ? (at.on_light ? "(light)" : "(camera)") : name_of_material(scene, at.material),
         three(at.value), v.left ? three(v.left->d) : "-", pdf, density(at.brought.x),
         density(at.brought.y)});
  }
  return markdown_table(std::move(rows)) + "\n";
}

json walk_json(const std::vector<PathEvent>& walk, const Replay& r, const Scene& scene) {
  json vertices = json::array();
  for (const WalkVertex& v : vertices_of(walk)) {
    const PathEvent& at = *v.arrived;
    json vertex{{"depth", at.depth}, {"p", place_of(at, r)}, {"beta", three_json(at.value)}};
    if (at.kind == EVENT_VERTEX) {
      vertex["normal"] = three_json(at.d);
      vertex["material"] = name_of_material(scene, at.material);
      vertex["dVCM"] = at.brought.x;
      vertex["dVC"] = at.brought.y;
    }
    vertex["wi"] = v.left ? three_json(v.left->d) : json();
    vertex["pdf"] = v.left ? json(v.left->d.w) : json();
    vertex["delta"] = v.left && v.left->d.w == 0;
    vertices.push_back(std::move(vertex));
  }
  return vertices;
}

std::string brought_table(const Replay& replay) {
  std::vector<std::vector<std::string>> rows{{"found by", "luminance", "share", "s", "t", "length",
                                              "weight", "unweighted R G B", "pdf of chance",
                                              "of light samples", "light path", "at"}};
  for (std::size_t i = 0; i < std::min(most_rows, replay.brought.size()); ++i) {
    const PathEvent& e = replay.brought[i];
    rows.push_back({strategy_name(e), fmt::format("{:.5g}", luminance_of(e)),
                    fmt::format("{:.2f} %", 100 * share_of(e, replay)), std::to_string(e.s),
                    std::to_string(e.t), std::to_string(length_of(e)), fmt::format("{:.4g}", e.p.w),
                    three(e.value), density(e.d.w), density(e.value.w),
                    light_path_of(e) == NONE ? "-" : std::to_string(light_path_of(e)),
                    place(e, replay)});
  }
  return markdown_table(std::move(rows), 1) + "\n";
}

json event_json(const PathEvent& e, const Replay& replay) {
  return {{"strategy", strategy_name(e)},
          {"s", e.s},
          {"t", e.t},
          {"length", length_of(e)},
          {"weight", e.p.w},
          {"value", three_json(e.value)},
          {"brought", three_json(e.brought)},
          {"share", share_of(e, replay)},
          {"p", place_of(e, replay)},
          {"wi", three_json(e.d)},
          {"pdf_chance", e.d.w},
          {"pdf_light_sample", e.value.w},
          {"light_path", light_path_of(e) == NONE ? json() : json(light_path_of(e))}};
}

}  // namespace

std::string replay_place(const Replay& r) {
  return fmt::format("{},{},{}", r.x, r.y, r.pass);
}

std::string replay_text(const Replay& r, const Scene& scene) {
  std::string text =
      fmt::format("pixel {},{} in pass {}: R G B {:.6g} {:.6g} {:.6g}, luminance {:.6g}\n\n", r.x,
                  r.y, r.pass, r.sum[0], r.sum[1], r.sum[2], luminance_of(r.sum));
  if (r.brought.empty()) {
    text += "no light was found\n";
  } else {
    const std::size_t count = r.brought.size();
    text += fmt::format(
        "{} part{} of it{}; {}\n{}", count, count == 1 ? "" : "s",
        count > most_rows ? fmt::format(", of which the brightest {}", most_rows) : "",
        r.adds_up() ? "added up, they are the sample bit for bit"
                    : fmt::format("added up, they differ from the film's {:.6g}", r.luminance),
        brought_table(r));
  }
  text += fmt::format("\neye path\n{}", walk_table(r.eye, r, scene));
  if (!r.light.empty())
    text += fmt::format("\nlight path {}, which takes part in the brightest\n{}",
                        r.light.front().path, walk_table(r.light, r, scene));
  return text;
}

json replay_json(const Replay& r, const Scene& scene) {
  json brought = json::array();
  for (const PathEvent& e : r.brought) brought.push_back(event_json(e, r));
  return {{"x", r.x},
          {"y", r.y},
          {"pass", r.pass},
          {"replay", replay_place(r)},
          {"sample", r.sum},
          {"luminance", luminance_of(r.sum)},
          {"adds_up", r.adds_up()},
          {"brought", brought},
          {"eye_path", walk_json(r.eye, r, scene)},
          {"light_path", r.light.empty() ? json() : walk_json(r.light, r, scene)},
          {"light_path_number", r.light.empty() ? json() : json(r.light.front().path)}};
}

std::string fireflies_text(const std::vector<FireflyReplay>& list) {
  if (list.empty()) return "no sample brought any light\n";
  std::vector<std::vector<std::string>> rows{{"replay", "excess", "luminance", "others", "found by",
                                              "share", "s", "t", "weight", "light path"}};
  for (const auto& [f, r] : list) {
    std::vector<std::string> row{
        replay_place(r), f.dropped ? "dropped" : fmt::format("{:.3g}", f.excess),
        fmt::format("{:.5g}", f.luminance), fmt::format("{:.5g}", f.others)};
    if (r.brought.empty()) {
      row.insert(row.end(), 6, "-");
    } else {
      const PathEvent& e = r.brought.front();
      const uint path = light_path_of(e);
      for (const std::string& cell :
           {std::string(strategy_name(e)), fmt::format("{:.3g} %", 100 * share_of(e, r)),
            std::to_string(e.s), std::to_string(e.t), fmt::format("{:.4g}", e.p.w),
            path == NONE ? std::string("-") : std::to_string(path)})
        row.push_back(cell);
    }
    rows.push_back(std::move(row));
  }
  return markdown_table(std::move(rows), 1) + "\n";
}

json fireflies_json(const std::vector<FireflyReplay>& list, const Scene& scene) {
  json all = json::array();
  for (const auto& [f, r] : list) {
    json one = replay_json(r, scene);
    one["dropped"] = f.dropped;
    one["others"] = f.others;
    one["excess"] = f.excess;
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace pellucid

// Walks that never end, and launches so long that a driver ends them (numerics 37).
//
// Numbers that are none, or out of range, are refused where they stand in the scene. A traversal
// visits every node once at most, and no walk exceeds DEPTH_HARD_LIMIT, which is counted; so even a
// direction that is NaN comes to an end. Passes are launched in parts of about 40 ms, by what the
// last ones took: some 0.02 ms each.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "scene/json_tree.h"
#include "scene/load.h"
#include "scene/text_file.h"
#include "stability/exact.h"
#include "stability/measurements.h"
#include "stability/probes.h"

namespace pellucid::stability {
namespace {

void collect_numbers(const JsonNode& node, std::vector<std::string>& paths) {
  if (node.kind == JsonNode::Kind::number) paths.push_back(node.path);
  for (const JsonNode& item : node.items) collect_numbers(item, paths);
  for (const JsonMember& member : node.members) collect_numbers(member.value, paths);
}

/// A picture of a scene that was taken although one of its numbers is odd: it ends, and is one.
void render_odd(const Lab& lab, const Scene& scene, const std::string& what, Findings& findings) {
  try {
    Renderer(lab, scene, {"path", 8, 8}).render({4, 1, long_enough, MIS_BALANCE});
  } catch (const NumericError& e) {
    findings.require(fmt::format("{}: {}", what, e.what()), false);
  }
}

void measure_odd_scenes(const Lab& lab, Findings& findings) {
  // Of those that are taken so many are rendered.
  const auto every = std::uint64_t(std::max(1.0, 25 / lab.effort));
  const std::string path = lab.open_scene("everything").path;
  std::vector<std::string> places;
  collect_numbers(parse_json(path, read_text_file(path, "scene", 1 << 20)), places);
  std::uint64_t nan_taken = 0, unnamed = 0, taken = 0;
  for (const char* value : {"NaN", "1e999", "1e300", "1e11", "-1e11", "1e-11", "0", "-1"})
    for (const std::string& place : places) {
      if (place == "film.width" || place == "film.height") continue;  // the size is ours
      const std::string change = place + "=" + value;
      try {
        const Scene scene = load_scene(path, {{change}, {}});
        nan_taken += value == std::string("NaN") || value == std::string("1e999");
        if (++taken % every == 0) render_odd(lab, scene, change, findings);
      } catch (const InputError& e) {
        // What numbers are together, such as a triangle without area, is told of their object.
        const std::string object = place.substr(0, place.find('.'));
        unnamed += std::string(e.what()).find(object) == std::string::npos;
      }
    }
  findings.none("numbers that are none and were taken", nan_taken);
  findings.none("refusals that do not say where", unnamed);
  findings.require("odd numbers that were taken", taken >= every);
}

/// Rays of which a number is none, or is infinite or 0: no walk goes on from them.
void measure_odd_rays(const Lab& lab, Findings& findings) {
  Scene scene = empty_scene();
  add_shape(scene, lump(2000));
  add_shape(scene, Sphere{{0, 0, 0}, 0.1});
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(),
                  infinite = std::numeric_limits<float>::infinity();
  Random random(5);
  std::vector<TraceRay> rays;
  for (float odd : {nan, infinite, -infinite, 0.0f})
    for (std::size_t i = 0; i < lab.count(3000); ++i) {
      TraceRay ray = ray_along(random.in_box(0.5), random.direction());
      float* const words[] = {&ray.ox, &ray.oy, &ray.oz, &ray.dx, &ray.dy, &ray.dz, &ray.t_max};
      // 0 is a fine coordinate: then the direction is 0 as a whole.
      if (odd == 0.0f)
        ray.dx = ray.dy = ray.dz = odd;
      else
        *words[i % 7] = odd;
      rays.push_back(ray);
    }
  constexpr uint bounces = 64;
  std::uint64_t too_long = 0, on = 0;
  const std::vector<WalkEnd> ends = WalkProbe(lab, scene).walk(rays, bounces);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    too_long += ends[i].bounces > bounces;
    const TraceRay& r = rays[i];
    const bool broken = !std::isfinite(r.ox + r.oy + r.oz + r.dx + r.dy + r.dz);
    on += broken && ends[i].bounces > 0;
  }
  findings.none("walks beyond the limit of their length", too_long);
  findings.none("walks that go on from a broken ray", on);
}

Film film_of(const Lab& lab, const Scene& scene, const char* method, std::size_t launch_items) {
  Build build = build_of(method);
  build.launch_items = launch_items;
  return session_render(lab, scene, build, short_run).film;
}

void measure_launches(const Lab& lab, Findings& findings) {
  constexpr int side = 400;
  constexpr double watchdog = 0.1;  // s
  constexpr int learning = 3;       // from launches of 1024 work-items to those of 40 ms
  constexpr int tries = 3;          // the machine may have other things to do
  const Scene scene = lab.open_scene("everything");
  for (const char* method : one_per_pass) {
    const Film whole = film_of(lab, scene, method, std::size_t{1} << 20);
    findings.none(fmt::format("pixels that differ in launches of 64 and 192 items, {}", method),
                  different_pixels(whole, film_of(lab, scene, method, 64)) +
                      different_pixels(whole, film_of(lab, scene, method, 192)));
    Build build{method, side, side};
    Renderer renderer(lab, scene, build);
    double longest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < learning; ++i) renderer.render({1, 1, {}, MIS_BALANCE});
    for (int i = 0; i < tries; ++i) {
      for (const PassState& state : renderer.plan().passes()) state.time->longest = 0;
      renderer.render({1, 1, {}, MIS_BALANCE});
      double of_all = 0;
      for (const PassState& state : renderer.plan().passes())
        of_all = std::max(of_all, state.time->longest);
      longest = std::min(longest, of_all);
    }
    findings.at_most(fmt::format("longest launch for 400 x 400 paths [s], {}", method), longest,
                     watchdog);
  }
}

}  // namespace

void everything_ends(const Lab& lab, Findings& findings) {
  measure_odd_scenes(lab, findings);
  measure_odd_rays(lab, findings);
  measure_launches(lab, findings);
}

}  // namespace pellucid::stability

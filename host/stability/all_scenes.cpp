// No scene makes a number that is none (numerics 4): every kernel counts samples that are NaN,
// infinite or negative, walks that lose their direction, stacks and sums that overflow; over scenes
// of every kind and all methods, nothing is counted.
//
// Guards stand at the source (COS_MIN, DIRECTION_MIN, FACET_COS_MIN); the film drops and counts
// what is no radiance, one test per sample.
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "base/error.h"
#include "integrators/registry.h"
#include "stability/measurements.h"
#include "stability/renderer.h"

namespace pellucid::stability {
namespace {

/// Kinds of paths that a method traces for every pixel and sample.
struct Kinds {
  std::uint64_t camera = 0, light = 0;
};

Kinds kinds_of(const Integrator& method) {
  Kinds kinds;
  for (const Pass& pass : method.passes)
    if (pass.name == "pt_mega" || pass.name == "camera_trace") kinds.camera = 1;
  if (method.walks_from_lights()) kinds.light = 1;
  return kinds;
}

/// One method on all scenes.
class Soak {
 public:
  Soak(const Lab& lab, const Integrator& method) : lab_(lab), method_(method) {}
  void render(const Scene& scene, int side, std::uint64_t spp);
  void report(Findings& findings) const;

 private:
  const Lab& lab_;
  const Integrator& method_;
  Kinds traced_;
  std::uint64_t errors_ = 0, odd_ = 0, short_ = 0;
  std::uint64_t in_rooms_ = 0, left_ = 0;  // paths in closed scenes, and those that left
  std::string what_;
};

void Soak::render(const Scene& scene, int side, std::uint64_t spp) {
  if (lab_.progress) lab_.progress(method_.name + " on " + scene.name);
  try {
    Renderer renderer(lab_, scene, {method_.name, side, side});
    const Picture picture = renderer.render({spp, 3, long_enough, MIS_BALANCE});
    left_ += renderer.take_escapes();
    const std::uint64_t samples = picture.film.passes.count() * picture.pixels.size();
    const Kinds kinds = kinds_of(method_);
    traced_.camera += samples * kinds.camera;
    traced_.light += samples * kinds.light;
    if (scene.closed) in_rooms_ += samples * (kinds.camera + kinds.light);
    for (const FilmPixel& pixel : picture.film.pixels) short_ += pixel.count[0] != spp;
    for (const auto& pixel : picture.pixels)
      for (const Estimate& e : pixel) odd_ += !(std::isfinite(e.mean) && e.mean >= 0);
  } catch (const NumericError& e) {
    ++errors_;
    what_ += fmt::format(" ({}: {})", scene.name, e.what());
  }
}

void Soak::report(Findings& findings) const {
  findings.none(
      fmt::format("scenes in which something was dropped, {}, {} paths from the camera and {} from "
                  "lights{}",
                  method_.name, traced_.camera, traced_.light, what_),
      errors_);
  findings.none("pixels that are no radiance, " + method_.name, odd_);
  findings.none("pixels that are short of a sample, by the device's count, " + method_.name,
                short_);
  findings.at_most("walks that leave a closed room, per 1e6 paths, " + method_.name,
                   double(left_) * 1e6 / double(in_rooms_), 2);
}

}  // namespace

void nothing_is_dropped(const Lab& lab, Findings& findings) {
  std::vector<const char*> names{"everything",    "materials",      "veach-mis", "pool",
                                 "glass-caustic", "mirror-caustic", "keyhole"};
  // Large pictures make few launches of many paths.
  const int side = lab.effort > 1 ? 256 : 32;
  if (lab.effort > 1) names.insert(names.end(), {"glass-lamp", "four-balls-sun"});
  std::vector<Scene> scenes;
  for (const char* name : names) scenes.push_back(lab.open_scene(name));
  for (Scene& scene : scenes) scene.closed = scene.name == "keyhole";  // the only room among them
  std::uint64_t paths_of_sample = 0;
  for (const Integrator& method : integrators())
    paths_of_sample += (kinds_of(method).camera + kinds_of(method).light) * scenes.size();
  const std::uint64_t wanted = lab.count(2000000);
  const std::uint64_t samples = (wanted + paths_of_sample - 1) / paths_of_sample;
  const std::uint64_t pixels = std::uint64_t(side) * std::uint64_t(side);
  for (const Integrator& method : integrators()) {
    Soak soak(lab, method);
    for (const Scene& scene : scenes) soak.render(scene, side, (samples + pixels - 1) / pixels);
    soak.report(findings);
  }
}

}  // namespace pellucid::stability

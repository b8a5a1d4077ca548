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

void nothing_is_dropped(const Lab& lab, Findings& findings) {
  std::vector<const char*> names{"everything", "materials",     "veach-mis",
                                 "pool",       "glass-caustic", "mirror-caustic"};
  const int side = lab.effort > 1 ? 32 : 16;
  if (lab.effort > 1) names.insert(names.end(), {"glass-lamp", "keyhole", "four-balls-sun"});
  std::vector<Scene> scenes;
  for (const char* name : names) scenes.push_back(lab.open_scene(name));
  for (const Integrator& method : integrators()) {
    std::uint64_t errors = 0, odd = 0;
    std::string what;
    for (const Scene& scene : scenes) {
      try {
        const Sampling run{lab.count(16), 3, long_enough, MIS_BALANCE};
        for (const auto& pixel : Renderer(lab, scene, {method.name, side, side}).render(run).pixels)
          for (const Estimate& e : pixel) odd += !(std::isfinite(e.mean) && e.mean >= 0);
      } catch (const NumericError& e) {
        ++errors;
        what += fmt::format(" ({}: {})", scene.name, e.what());
      }
    }
    findings.none("scenes in which something was dropped, " + method.name + what, errors);
    findings.none("pixels that are no radiance, " + method.name, odd);
  }
}

}  // namespace pellucid::stability

// The tests' tier, device and scenes.
#include "render_harness.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "scene/load.h"
#include "support/kernel_folder.h"

namespace pellucid::test {

double tier_tolerance() {
  const char* tier = std::getenv("PELLUCID_TIER");
  return tier && std::string(tier) == "full" ? 0.005 : 0.015;
}

double tier_effort() {
  const double ratio = 0.015 / tier_tolerance();
  return ratio * ratio;
}

const Lab& test_lab() {
  static const Lab lab = [] {
    const char* spec = std::getenv("PELLUCID_DEVICE");
    return Lab{Device::open(spec ? spec : ""), kernel_folder(), 1, scene_named};
  }();
  return lab;
}

Scene scene_named(const std::string& name) {
  const std::string root = PELLUCID_SOURCE_DIR;
  return load_scene(find_scene(name, {root + "/tests/render/scenes", root + "/scenes"}));
}

std::string judge(const Estimate& e, double expected, double slack) {
  constexpr double sigmas = 4.5;
  const double off = std::abs(e.mean - expected), width = sigmas * e.error() + slack * expected;
  const std::string found =
      fmt::format("{:.7g} +- {:.2g} ({:+.3f} %, {:.2f} sigma) instead of {:.7g}", e.mean, e.error(),
                  100 * (e.mean / expected - 1), off / e.error(), expected);
  if (!(off <= width)) return "WRONG: " + found;
  if (!(off + width <= tier_tolerance() * expected)) return "INCONCLUSIVE, too noisy: " + found;
  return "";
}

}  // namespace pellucid::test

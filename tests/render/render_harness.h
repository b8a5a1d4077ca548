// The suite's renderer on the device under test, scenes by name, and verdicts on values.
#pragma once

#include <string>

#include "stability/renderer.h"

namespace pellucid::test {

using namespace pellucid::stability;

/// Half width of the verdict: +-1.5 % in CI, +-0.5 % where PELLUCID_TIER=full (accuracy.md 4).
double tier_tolerance();
/// Samples grow with 1/tolerance^2.
double tier_effort();

/// The device under test; tests fail, never skip, where there is none.
const Lab& test_lab();
inline const Device& test_device() {
  return test_lab().device;
}

/// By name from tests/render/scenes or the shipped ones.
Scene scene_named(const std::string& name);

struct Renderer : stability::Renderer {
  Renderer(const Scene& scene, const Build& build)
      : stability::Renderer(test_lab(), scene, build) {}
};

inline Picture session_render(const Scene& scene, const Build& build, const Sampling& run,
                              const RenderHooks& hooks = {}) {
  return stability::session_render(test_lab(), scene, build, run, hooks);
}

/// Verdict on a value known exactly: "" if the mean lies within 4.5 standard errors (plus `slack`,
/// relative, for what is not noise) and that interval inside +-tier_tolerance() of `expected`; else
/// the reason. 4.5 sigma are 7e-6, two-sided: with fixed seeds this only says how unlucky a seed
/// may be.
std::string judge(const Estimate& estimate, double expected, double slack);

}  // namespace pellucid::test

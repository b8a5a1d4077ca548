// Relaxed arithmetic (numerics 5): `mad` and `fast` render the pictures of `strict`, lose nothing
// through closed meshes, and count no error.
//
// The device's own arithmetic is probed against double, mode by mode (shared/probe.h).
//
// What must not be relaxed is not: where rays meet shapes every operation is rounded as written in
// all modes (EXACT_BEGIN), no infinity is computed with, and NaN is told by its bits.
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "render/math_probe.h"
#include "stability/exact.h"
#include "stability/measurements.h"
#include "stability/small_scenes.h"

namespace pellucid::stability {
namespace {

Picture render(const Lab& lab, const Scene& scene, const char* method, FloatMode mode) {
  Build build{method, 16, 16};
  build.float_mode = mode;
  return Renderer(lab, scene, build).render({lab.count(64), 1, long_enough, MIS_BALANCE});
}

/// Lit scenes, and most that pixels may differ in the mean: ten times what was seen. Inside of
/// glass, roundings grow with every bounce, so paths part (README, double twin).
constexpr struct {
  const char* name;
  double bound;
} scenes[] = {{"everything", 5e-6},   {"equal-lights", 5e-6}, {"equal-shading", 5e-6},
              {"mirror-strip", 5e-6}, {"materials", 5e-5},    {"veach-mis", 5e-5},
              {"glass-caustic", 1e-2}};

/// Sum of |a - b| over pixels and channels, over that of a: by the same random numbers, so that
/// only paths which go another way make more of it than rounding.
double apart(const Picture& a, const Picture& b) {
  double off = 0, all = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      off += std::abs(a.pixels[i][c].mean - b.pixels[i][c].mean);
      all += a.pixels[i][c].mean;
    }
  return off / all;
}

}  // namespace

void relaxed_modes_keep_the_picture(const Lab& lab, Findings& findings) {
  Device device = lab.device;
  for (FloatMode mode : {FloatMode::strict, FloatMode::mad, FloatMode::fast})
    for (const MathError& e : probe_math(device, mode))
      findings.at_most(fmt::format("{} of 1e6 arguments in {}: {} off", e.function,
                                   float_mode_name(mode), e.unit),
                       e.worst, e.bound);
  for (FloatMode mode : {FloatMode::mad, FloatMode::fast})
    aimed_rays_hit(lab, findings, {0, true, mode});
  const Scene box = light_tight_box();
  std::vector<const char*> tried{"path", "bdpt", "vcm"};
  // Their passes are among those, but have to be compiled anew, three times.
  if (lab.effort > 1) tried.insert(tried.end(), {"light", "sppm", "bpm"});
  for (const char* method : tried) {
    for (const auto& [name, bound] : scenes) {
      const Scene scene = lab.open_scene(name);
      const Picture strict = render(lab, scene, method, FloatMode::strict);
      for (FloatMode mode : {FloatMode::mad, FloatMode::fast})
        findings.at_most(fmt::format("{} of {} beside strict, {}: mean difference of pixels",
                                     float_mode_name(mode), name, method),
                         apart(strict, render(lab, scene, method, mode)), bound);
    }
    for (FloatMode mode : {FloatMode::mad, FloatMode::fast}) {
      std::uint64_t lit = 0;
      for (const auto& pixel : render(lab, box, method, mode).pixels) lit += pixel[0].mean != 0;
      findings.none(
          fmt::format("lit pixels in a closed box by {}, {}", float_mode_name(mode), method), lit);
    }
  }
}

}  // namespace pellucid::stability

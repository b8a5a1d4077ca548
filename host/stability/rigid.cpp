// Moves that reorder roundings: far from the origin (numerics 9) and mirrored (31) the picture
// stays the same within its noise.
//
// Hit points are rebuilt from barycentrics and their error is bounded by their coordinates, so rays
// start off surfaces wherever these are. Positions themselves are floats in world space: where
// their rounding shows, loading warns of it with the figure (scene/distance.h).
#include <fmt/format.h>

#include "scene/distance.h"
#include "stability/estimates.h"
#include "stability/measurements.h"
#include "stability/small_scenes.h"

namespace pellucid::stability {
namespace {

constexpr double width = 2;  ///< of the scene, which lies on a dyadic grid

Scene moved(const Scene& scene, const glm::dvec3& scale, double sizes) {
  Scene there = scene;
  transform_points(there, scale, width * sizes * glm::dvec3(1, -1, 1));
  return there;
}

std::array<Estimate, 3> means(const Lab& lab, const Scene& scene, const char* method) {
  // Noise of two such adds up.
  return measured_means(lab, scene, {method, 16, 16}, {}, 0.6 * usual_resolution);
}

}  // namespace

void far_away_is_as_near(const Lab& lab, Findings& findings) {
  const Scene here = lab.open_scene("equal-lights");
  for (const char* method : {"path", "bdpt", "vcm"}) {
    const std::array<Estimate, 3> near = means(lab, here, method);
    for (double sizes : {1e2, 1e4})
      compare_means(lab, findings, fmt::format("moved by {:g} sizes, {}", sizes, method),
                    means(lab, moved(here, glm::dvec3(1), sizes), method), near);
  }
  findings.require("no warning at 1e4 sizes",
                   distance_warning(moved(here, glm::dvec3(1), 1e4)).empty());
  findings.warning = distance_warning(moved(here, glm::dvec3(1), 1e6));
  findings.require("a warning at 1e6 sizes", !findings.warning.empty());
}

void mirrored_is_the_same(const Lab& lab, Findings& findings) {
  const Scene here = lab.open_scene("equal-lights");
  for (const char* method : {"path", "bdpt"}) {
    const std::array<Estimate, 3> plain = means(lab, here, method);
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 scale(1);
      scale[axis] = -1;
      compare_means(lab, findings, fmt::format("mirrored along axis {}, {}", axis, method),
                    means(lab, moved(here, scale, 0), method), plain);
    }
  }
}

}  // namespace pellucid::stability

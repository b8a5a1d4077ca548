// Frames around normals, and what a thousand bounces make of a direction (numerics 33).
//
// Bases that divide by 1 + n.z break near -z; the branch by the sign of n.z [Duff17] has no such
// place and costs one division. Directions are normalised once per bounce (transport/vertex.h), one
// root: without, |d| drifts as a random walk and biases densities and distances alike.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "stability/measurements.h"
#include "stability/probes.h"
#include "stability/small_scenes.h"

namespace pellucid::stability {
namespace {

glm::dvec3 vec(const F4& v) {
  return {v.x, v.y, v.z};
}

/// Normal of a cell of a grid x grid octahedral map, rounded to floats.
F4 normal_of(int column, int row, int grid) {
  const double x = (2.0 * column + 1) / grid - 1, y = (2.0 * row + 1) / grid - 1;
  glm::dvec3 n(x, y, 1 - std::abs(x) - std::abs(y));
  if (n.z < 0)
    n = {(1 - std::abs(y)) * (x < 0 ? -1 : 1), (1 - std::abs(x)) * (y < 0 ? -1 : 1), n.z};
  n = glm::normalize(n);
  return {float(n.x), float(n.y), float(n.z), 0};
}

struct Worst {
  double off = 0;    ///< from orthonormal and right-handed
  double turns = 0;  ///< of s between neighbours on the same side of z = 0, over that of n

  void add(const glm::dvec3& n, const glm::dvec3& s, const glm::dvec3& t) {
    // The normal is a rounded one: |n| is off by half an ulp of its own.
    const glm::dvec3 handed = glm::cross(s, t) - n;
    off = std::max({off, std::abs(glm::length(s) - 1), std::abs(glm::length(t) - 1),
                    std::abs(glm::dot(s, t)), std::abs(glm::dot(s, n)), std::abs(glm::dot(t, n)),
                    std::abs(handed.x), std::abs(handed.y), std::abs(handed.z)});
  }
};

void measure_frames(const Lab& lab, Findings& findings) {
  constexpr int grid = 4096, rows = 64;  // 2^24 normals, a band at a time
  FrameProbe probe(lab);
  Worst worst;
  for (int first = 0; first < grid; first += rows) {
    std::vector<F4> normals;
    for (int row = first; row < first + rows; ++row)
      for (int column = 0; column < grid; ++column) normals.push_back(normal_of(column, row, grid));
    const std::vector<DeviceFrame> frames = probe.frames(normals);
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const glm::dvec3 n = vec(normals[i]), s = vec(frames[i].s);
      worst.add(n, s, vec(frames[i].t));
      if (i % grid == 0 || (n.z < 0) != (normals[i - 1].z < 0)) continue;
      worst.turns = std::max(worst.turns, glm::length(s - vec(frames[i - 1].s)) /
                                              glm::length(n - vec(normals[i - 1])));
    }
  }
  findings.at_most("frames of 2^24 normals: off orthonormal and right-handed", worst.off, 2e-7);
  findings.at_most("frames of neighbours: turn of s over that of n", worst.turns, 4);
}

/// A thousand bounces in a closed lump of mirrors.
void measure_drift(const Lab& lab, Findings& findings) {
  constexpr uint bounces = 1000;
  Scene scene = empty_scene(1.0);
  scene.materials[0].kind = MaterialKind::mirror;
  add_shape(scene, lump(2000));
  Random random(3);
  std::vector<TraceRay> rays;
  for (std::size_t i = 0; i < lab.count(1024); ++i)
    rays.push_back(ray_along(random.in_box(0.1), random.direction()));
  std::uint64_t short_walks = 0;
  double drift = 0;
  for (const WalkEnd& end : WalkProbe(lab, scene).walk(rays, bounces)) {
    short_walks += end.bounces != bounces;
    drift = std::max(drift, std::abs(glm::length(glm::dvec3(end.dx, end.dy, end.dz)) - 1));
  }
  findings.at_most("| |d| - 1 | after 1000 mirrors", drift, 1e-6);
  findings.none("walks that end before", short_walks);
}

}  // namespace

void frames_and_directions_do_not_drift(const Lab& lab, Findings& findings) {
  measure_frames(lab, findings);
  measure_drift(lab, findings);
}

}  // namespace pellucid::stability

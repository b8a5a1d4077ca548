// The distance of a scene, from the bounds of its shapes.
#include "scene/distance.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace pellucid {
namespace {

struct Bounds {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high = -low;

  void add(const glm::dvec3& p, double radius = 0) {
    low = glm::min(low, p - radius), high = glm::max(high, p + radius);
  }
};

Bounds bounds_of(const Scene& scene) {
  Bounds b;
  for (const Shape& shape : scene.shapes)
    if (const Mesh* mesh = std::get_if<Mesh>(&shape.geometry)) {
      for (const glm::vec3& p : mesh->positions) b.add(p);
    } else if (const Sphere* sphere = std::get_if<Sphere>(&shape.geometry)) {
      b.add(sphere->center, sphere->radius);
    } else {
      const Disk& disk = std::get<Disk>(shape.geometry);
      b.add(disk.center, disk.radius);
    }
  return b;
}

}  // namespace

std::string distance_warning(const Scene& scene) {
  // Of the size of the scene: a pixel or so of a picture that shows all of it. Where this is
  // exceeded, pictures differ from those of the scene at the origin (stability case far-away).
  constexpr double visible = 1e-3, roundoff = 0x1p-24;
  if (scene.shapes.empty()) return "";
  const Bounds b = bounds_of(scene);
  const glm::dvec3 extent = b.high - b.low, far = glm::max(glm::abs(b.low), glm::abs(b.high));
  const double size = std::max({extent.x, extent.y, extent.z}),
               reach = std::max({far.x, far.y, far.z});
  const double error = roundoff * reach;
  if (!(error > visible * size)) return "";
  return fmt::format(
      "the scene is {:.3g} wide and lies {:.3g} from the origin, where positions are rounded by up "
      "to {:.2g}, {:.2g} % of it; move it and its camera nearer to the origin",
      size, reach, error, 100 * error / size);
}

}  // namespace pellucid

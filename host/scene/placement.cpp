// Shapes from coordinates of the file, in double, to those of the scene, which become floats:
// counted from the middle of a scene that lies far from the origin.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/bounds.h"
#include "scene/parse.h"

namespace pellucid {
namespace {

Bounds bounds_of(const SceneBuilder& builder) {
  Bounds b;
  for (const UnplacedMesh& mesh : builder.unplaced)
    for (const glm::uvec3& t : mesh.raw.triangles)
      for (int i = 0; i < 3; ++i) b.add(mesh.transform.point(mesh.raw.positions[t[i]]));
  for (const Shape& shape : builder.scene.shapes)
    if (!std::holds_alternative<Mesh>(shape.geometry)) b.add(bounds_of(shape));
  return b;
}

/// Its own origin for what is near enough to it; else the middle, rounded to a power of two that is
/// no less than the size: then scenes that differ by whole multiples of it have the same bits.
glm::dvec3 best_origin(const Bounds& bounds) {
  // In sizes of the scene: up to there positions keep 17 of their 24 bits.
  constexpr double near_enough = 128;
  const double size = bounds.size();
  const bool far = size > 0 && bounds.reach() > near_enough * size;  // of nothing it is -infinity
  if (!far) return glm::dvec3(0.0);
  const double step = std::ldexp(1.0, std::ilogb(size) + 1);
  // + 0 leaves no -0, which is no way to write a place.
  return glm::round(0.5 * (bounds.low + bounds.high) / step) * step + 0.0;
}

void place(UnplacedMesh& mesh, Scene& scene) {
  Shape& shape = scene.shapes[mesh.shape];
  mesh.transform.offset -= scene.origin;
  BakedMesh baked = bake_mesh(std::move(mesh.raw), mesh.transform, mesh.flip);
  if (!baked.finite)
    fail(*mesh.node, fmt::format("{} reaches beyond coordinates of {:g}; scale it down", shape.name,
                                 largest_length));
  if (baked.mesh.triangles.empty())
    fail(*mesh.node, fmt::format("{} has no triangle with an area", shape.name));
  if (baked.dropped > 0)
    scene.warnings.push_back(
        fmt::format("{}: {} triangles without area were left out", shape.name, baked.dropped));
  shape.geometry = std::move(baked.mesh);
}

}  // namespace

void place_shapes(SceneBuilder& builder) {
  Scene& scene = builder.scene;
  scene.origin = best_origin(bounds_of(builder));
  for (UnplacedMesh& mesh : builder.unplaced) place(mesh, scene);
  builder.unplaced.clear();
  for (Shape& shape : scene.shapes)
    if (Sphere* sphere = std::get_if<Sphere>(&shape.geometry)) {
      sphere->center -= scene.origin;
    } else if (Disk* disk = std::get_if<Disk>(&shape.geometry)) {
      disk->center -= scene.origin;
    }
  if (scene.origin != glm::dvec3(0.0))
    scene.notes.push_back(fmt::format(
        "{} lies far from the origin: its coordinates are counted from {:.10g} {:.10g} {:.10g}",
        scene.name, scene.origin.x, scene.origin.y, scene.origin.z));
}

}  // namespace pellucid

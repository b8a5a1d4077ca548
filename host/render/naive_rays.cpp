// Leaves of vertices made into leaves of edges.
#include "render/naive_rays.h"

#include "base/error.h"

namespace pellucid {

PackedScene for_naive_rays(PackedScene scene) {
  PELLUCID_CHECK(!scene.features.has(FEAT_SPHERES) && !scene.features.has(FEAT_DISKS),
                 "naive rays are for triangles");
  const std::size_t vertex = 3 * std::size_t(scene.simd_width), block = 3 * vertex;
  for (std::size_t at = 0; at + block <= scene.leaves.size(); at += block)
    for (std::size_t i = vertex; i < block; ++i)
      scene.leaves[at + i] -= scene.leaves[at + i % vertex];
  return scene;
}

}  // namespace pellucid

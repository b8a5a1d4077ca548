// From the scene in human units to the arrays that kernels read: shared structs, BVH, features.
// Testable without a device.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "bvh/bvh.h"
#include "pack/features.h"
#include "scene/scene.h"
#include "shared/layout.h"
#include "shared/limits.h"

namespace pellucid {

/// What the device prescribes for the layout.
struct PackOptions {
  int simd_width = 8;  ///< children per node and triangles per leaf block: 4, 8 or 16
};

/// Arrays as uploaded. Empty arrays get one zero element, so that every buffer exists.
struct PackedScene {
  std::vector<float> nodes;      ///< [nodes][7][simd_width]
  std::vector<float> leaves;     ///< [blocks][3][3][simd_width]
  std::vector<uint> leaf_prims;  ///< [blocks][simd_width]
  std::vector<Quadric> quadrics;
  std::vector<Triangle> triangles;
  std::vector<F4> positions, normals;
  std::vector<float> uvs;  ///< [vertices][2]
  std::vector<::Shape> shapes;
  std::vector<::Material> materials;
  std::vector<::Texture> textures;
  std::vector<uint> texels;  ///< [texels][2]
  std::vector<::Light> lights;
  std::vector<float> filter_table;   ///< [FILTER_STEPS + 1], or empty for the box
  std::vector<float> filter_values;  ///< the same
  SceneInfo info{};
  ::Camera camera{};
  std::array<double, 3> origin{};  ///< that coordinates are counted from, in those of the file
  FeatureSet features;             ///< what the scene needs
  int brightness_exponent = 0;     ///< 2^it is at least the radiance of the brightest light
  double light_power = 0;          ///< of all lights [W], the mean of the channels
  int simd_width = 8;
  uint stack_bound = 0;  ///< traversal stack entries needed
  bvh::Statistics bvh;
  double bvh_seconds = 0;
};

/// Bytes of one of these arrays. Not by the name of its type: in this namespace Shape, Material and
/// Light are those of the scene model.
template <typename T>
std::size_t bytes_of(const std::vector<T>& array) {
  return array.size() * sizeof(T);
}

/// Throws InputError where the scene exceeds a limit of the layout.
PackedScene pack_scene(const Scene& scene, const PackOptions& options);

}  // namespace pellucid

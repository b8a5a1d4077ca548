// pack_scene: the steps in order, and the camera.
#include "pack/pack.h"

#include <cmath>

#include "base/error.h"
#include "pack/packer.h"

namespace pellucid {
namespace {

/// Distance of the image plane in pixels: a pixel there has area 1 [Georgiev12].
double plane_distance(const Camera& camera, int width, int height) {
  bool along_x = camera.fov_axis == FovAxis::x;
  if (camera.fov_axis == FovAxis::smaller) along_x = width <= height;
  if (camera.fov_axis == FovAxis::larger) along_x = width >= height;
  const double half_angle = 0.5 * camera.fov * 3.14159265358979323846 / 180.0;
  return 0.5 * (along_x ? width : height) / std::tan(half_angle);
}

::Camera pack_camera(const Camera& camera, int width, int height) {
  const double distance = plane_distance(camera, width, height);
  const glm::dvec3 dx = camera.right / distance, dy = -camera.up / distance;
  ::Camera out{};
  out.origin = to_f4(camera.origin);
  out.corner = to_f4(camera.forward - dx * (0.5 * width) - dy * (0.5 * height));
  out.dx = to_f4(dx);
  out.dy = to_f4(dy);
  out.forward = to_f4(camera.forward, distance);
  return out;
}

/// OpenCL has no empty buffers.
template <typename T>
void never_empty(std::vector<T>& v) {
  if (v.empty()) v.resize(1);
}

}  // namespace

PackedScene pack_scene(const Scene& scene, const PackOptions& options) {
  PELLUCID_CHECK(options.simd_width == 4 || options.simd_width == 8 || options.simd_width == 16,
                 "lanes of a node");
  PackedScene out;
  out.simd_width = options.simd_width;
  pack_materials(scene.materials, out);
  pack_shapes(scene, out);
  if (out.features.has(FEAT_TEXTURE)) pack_textures(scene, out);
  pack_bvh(out);
  pack_lights(scene, out);
  pack_filter(scene, out);
  out.origin = {scene.origin.x, scene.origin.y, scene.origin.z};
  out.camera = pack_camera(scene.camera, scene.settings.width, scene.settings.height);
  never_empty(out.nodes), never_empty(out.leaves), never_empty(out.leaf_prims);
  never_empty(out.quadrics), never_empty(out.triangles), never_empty(out.positions);
  never_empty(out.normals), never_empty(out.shapes), never_empty(out.materials);
  never_empty(out.lights), never_empty(out.uvs), never_empty(out.textures);
  never_empty(out.texels), never_empty(out.filter_table);
  never_empty(out.filter_values);
  return out;
}

}  // namespace pellucid

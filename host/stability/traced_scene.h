// Lists of rays through the device's own traversal, the very one that renders use.
#pragma once

#include <string>
#include <vector>

#include "pack/triangle_start.h"
#include "render/ray_tracer.h"
#include "stability/lab.h"
#include "stability/small_scenes.h"

namespace pellucid::stability {

/// How the traversal is built.
struct RayConfig {
  int width = 0;  ///< lanes of a node; 0: what a render would take on this device
  bool builtins = true;
  FloatMode float_mode = FloatMode::strict;
  bool naive = false;  ///< by kernels/naive (render/naive_rays.h), to compare with
};
/// As on this device, but naive.
constexpr RayConfig naive_rays{0, true, FloatMode::strict, true};
/// Widths 4, 8, 16, each with and without compiler builtins.
std::vector<RayConfig> all_configs();
std::string name_of(const RayConfig& config);

struct BothHits {
  std::vector<TraceHit> closest, any;
};

/// A scene on the device.
class TracedScene {
 public:
  TracedScene(const Lab& lab, const Scene& scene, const RayConfig& config = {});

  /// Goes on with another scene, quicker than by a TracedScene of its own.
  void set_scene(const Scene& scene);

  std::vector<TraceHit> closest(const std::vector<TraceRay>& rays);
  BothHits both(const std::vector<TraceRay>& rays);
  /// Errors that the device counted since the last call.
  std::uint64_t errors();
  /// Corner k of a triangle.
  glm::vec3 corner(uint prim, int k) const;

 private:
  PackedScene pack(const Scene& scene) const;

  int width_;
  bool naive_;

 public:
  PackedScene packed;

 private:
  RayTracer tracer_;
};

/// Both rounded to float.
TraceRay ray_along(const glm::dvec3& o, const glm::dvec3& d);
/// From `o`, rounded to float, towards `target`: only then is the direction computed and rounded.
TraceRay ray_towards(const glm::dvec3& o, const glm::dvec3& target);
inline glm::dvec3 origin_of(const TraceRay& r) {
  return {r.ox, r.oy, r.oz};
}
inline glm::dvec3 direction_of(const TraceRay& r) {
  return {r.dx, r.dy, r.dz};
}

/// Where a ray may start that leaves a hit.
struct Start : TriangleStart {
  float epsilon = 0;  ///< naive code: how far along the ray it starts
  TraceRay towards(const glm::vec3& w) const;
};
/// As kernels have it.
Start start_at(const TracedScene& scene, const TraceHit& hit);
/// The same as naive code has it: at o + t d, an epsilon along the new ray.
Start naive_start_at(const TracedScene& scene, const TraceRay& ray, const TraceHit& hit);

/// (n + 1)^2 points over corner + [0,1] a + [0,1] b, two triangles per cell; `stretch` > 1 makes
/// cells of very different sizes.
RawMesh grid(int n, const glm::dvec3& corner, const glm::dvec3& a, const glm::dvec3& b,
             double stretch = 1.0);
/// Appends `other`; triangle ids of `mesh` stay.
void append(RawMesh& mesh, const RawMesh& other);

}  // namespace pellucid::stability

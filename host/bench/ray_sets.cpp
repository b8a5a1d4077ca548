// Deterministic ray sets in double, rounded once.
#include "bench/ray_sets.h"

#include <array>
#include <cmath>
#include <limits>

#include "pack/triangle_start.h"

namespace pellucid {
namespace {

constexpr double pi = 3.14159265358979323846;
using Vec = std::array<double, 3>;

Vec operator+(const Vec& a, const Vec& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Vec operator-(const Vec& a, const Vec& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vec operator*(const Vec& a, double s) {
  return {a[0] * s, a[1] * s, a[2] * s};
}
double dot(const Vec& a, const Vec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vec unit(const Vec& a) {
  return a * (1.0 / std::sqrt(dot(a, a)));
}

Vec vec(const F4& v) {
  return {v.x, v.y, v.z};
}

/// SplitMix64 as a counter: number k of a stream does not depend on the others.
double uniform(std::uint64_t k) {
  k = (k + 1) * 0x9e3779b97f4a7c15ull;
  k = (k ^ (k >> 30)) * 0xbf58476d1ce4e5b9ull;
  k = (k ^ (k >> 27)) * 0x94d049bb133111ebull;
  return double((k ^ (k >> 31)) >> 11) * 0x1p-53;
}

TraceRay ray_from(const Vec& o, const Vec& d, double t_max) {
  return {float(o[0]), float(o[1]), float(o[2]), float(t_max),
          float(d[0]), float(d[1]), float(d[2]), 0.0f};
}

struct Start {
  Vec p, n;  ///< n on the side that the ray came from; p already off the surface
};

/// Where the next ray starts, as kernels have it.
Start start_at(const PackedScene& scene, const TraceRay& ray, const TraceHit& hit) {
  const TriangleStart s = triangle_start(scene, hit.prim, hit.b1, hit.b2);
  Vec n = unit({s.ng.x, s.ng.y, s.ng.z});
  if (dot(n, {ray.dx, ray.dy, ray.dz}) > 0) n = n * -1.0;
  return {Vec{s.p.x, s.p.y, s.p.z} + n * s.offset, n};
}

}  // namespace

const char* ray_kind_name(RayKind kind) {
  return kind == RayKind::primary ? "primary" : kind == RayKind::diffuse ? "diffuse" : "shadow";
}

static std::vector<TraceRay> primary_rays(const ::Camera& camera, int width, int height) {
  std::vector<TraceRay> rays;
  rays.reserve(std::size_t(width) * std::size_t(height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      rays.push_back(ray_from(
          vec(camera.origin),
          unit(vec(camera.corner) + vec(camera.dx) * (x + 0.5) + vec(camera.dy) * (y + 0.5)),
          std::numeric_limits<float>::max()));
  return rays;
}

static std::vector<TraceRay> diffuse_rays(const PackedScene& scene,
                                          const std::vector<TraceRay>& rays,
                                          const std::vector<TraceHit>& hits) {
  std::vector<TraceRay> out;
  out.reserve(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].prim == NONE) continue;
    const Start start = start_at(scene, rays[i], hits[i]);
    // Cosine-distributed: the normal plus a point of the unit sphere.
    const double z = 1.0 - 2.0 * uniform(2 * i), phi = 2.0 * pi * uniform(2 * i + 1);
    const double r = std::sqrt(1.0 - z * z);
    const Vec d = start.n * 1.000001 + Vec{r * std::cos(phi), r * std::sin(phi), z};
    out.push_back(ray_from(start.p, unit(d), std::numeric_limits<float>::max()));
  }
  return out;
}

static std::vector<TraceRay> shadow_rays(const PackedScene& scene,
                                         const std::vector<TraceRay>& rays,
                                         const std::vector<TraceHit>& hits, const float* center,
                                         double extent) {
  std::vector<TraceRay> out;
  out.reserve(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].prim == NONE) continue;
    const Start start = start_at(scene, rays[i], hits[i]);
    const Vec target{center[0] + extent * (uniform(2 * i + 1000003) - 0.5), center[1],
                     center[2] + extent * (uniform(2 * i + 1000004) - 0.5)};
    const Vec d = target - start.p;
    const double distance = std::sqrt(dot(d, d));
    out.push_back(ray_from(start.p, d * (1.0 / distance), distance));
  }
  return out;
}

std::vector<RaySet> ray_sets(RayTracer& tracer, const PackedScene& scene, int width, int height) {
  const std::vector<TraceRay> primary = primary_rays(scene.camera, width, height);
  tracer.set_rays(primary);
  tracer.trace(false);
  const std::vector<TraceHit> hits = tracer.hits();
  const float light[3] = {0.0f, 2.9f, 0.0f};  // under the room's ceiling
  constexpr double light_side = 2.0;
  return {{RayKind::primary, primary},
          {RayKind::diffuse, diffuse_rays(scene, primary, hits)},
          {RayKind::shadow, shadow_rays(scene, primary, hits, light, light_side)}};
}

}  // namespace pellucid

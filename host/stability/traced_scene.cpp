// Lists of rays through the device's own traversal.
#include "stability/traced_scene.h"

#include <cmath>
#include <limits>

#include "render/naive_rays.h"
#include "shared/limits.h"

namespace pellucid::stability {
namespace {

PlanOptions plan_options(const Lab& lab, const RayConfig& config) {
  PlanOptions options;
  options.simd_builtins = config.builtins;
  options.float_mode = config.float_mode;
  options.kernel_dir = lab.kernel_dir;
  if (config.naive) options.overlay = NAIVE_OVERLAY;
  return options;
}

}  // namespace

std::vector<RayConfig> all_configs() {
  return {{4, true}, {4, false}, {8, true}, {8, false}, {16, true}, {16, false}};
}

std::string name_of(const RayConfig& config) {
  if (config.float_mode != FloatMode::strict) return float_mode_name(config.float_mode);
  if (!config.width) return "default";
  return std::to_string(config.width) + (config.builtins ? " builtin" : " portable");
}

TracedScene::TracedScene(const Lab& lab, const Scene& scene, const RayConfig& config)
    : width_(config.width ? config.width : simd_width_for(lab.device.info())),
      naive_(config.naive),
      packed(pack(scene)),
      tracer_(lab.device, packed, plan_options(lab, config)) {}

PackedScene TracedScene::pack(const Scene& scene) const {
  PackedScene result = pack_scene(scene, {width_});
  return naive_ ? for_naive_rays(std::move(result)) : result;
}

void TracedScene::set_scene(const Scene& scene) {
  packed = pack(scene);
  tracer_.set_scene(packed);
}

std::vector<TraceHit> TracedScene::closest(const std::vector<TraceRay>& rays) {
  tracer_.set_rays(rays);
  tracer_.trace(false);
  return tracer_.hits();
}

BothHits TracedScene::both(const std::vector<TraceRay>& rays) {
  BothHits out;
  out.closest = closest(rays);
  tracer_.trace(true);
  out.any = tracer_.hits();
  return out;
}

std::uint64_t TracedScene::errors() {
  return error_count(tracer_.take_counters());
}

glm::vec3 TracedScene::corner(uint prim, int k) const {
  const Triangle& t = packed.triangles[prim];
  const F4& p = packed.positions[k == 0 ? t.v0 : k == 1 ? t.v1 : t.v2];
  return {p.x, p.y, p.z};
}

TraceRay ray_along(const glm::dvec3& o, const glm::dvec3& d) {
  const glm::vec3 of(o), df(d);
  return {of.x, of.y, of.z, std::numeric_limits<float>::max(), df.x, df.y, df.z, 0.0f};
}

TraceRay ray_towards(const glm::dvec3& o, const glm::dvec3& target) {
  const glm::dvec3 from{glm::vec3(o)};
  return ray_along(from, glm::normalize(target - from));
}

Start start_at(const TracedScene& scene, const TraceHit& hit) {
  return {triangle_start(scene.packed, hit.prim, hit.b1, hit.b2)};
}

Start naive_start_at(const TracedScene& scene, const TraceRay& ray, const TraceHit& hit) {
  Start s = start_at(scene, hit);
  s.p = {std::fma(hit.t, ray.dx, ray.ox), std::fma(hit.t, ray.dy, ray.oy),
         std::fma(hit.t, ray.dz, ray.oz)};
  s.offset = 0;
  s.epsilon = NAIVE_EPSILON;
  return s;
}

TraceRay Start::towards(const glm::vec3& w) const {
  return ray_along(TriangleStart::towards(w) + w * epsilon, w);
}

RawMesh grid(int n, const glm::dvec3& corner, const glm::dvec3& a, const glm::dvec3& b,
             double stretch) {
  RawMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      mesh.positions.push_back(corner + std::pow(double(i) / n, stretch) * a +
                               std::pow(double(j) / n, stretch) * b);
  const auto row = unsigned(n + 1);
  for (unsigned j = 0; j < unsigned(n); ++j)
    for (unsigned i = 0; i < unsigned(n); ++i) {
      const unsigned v = j * row + i;
      mesh.triangles.emplace_back(v, v + 1, v + row + 1);
      mesh.triangles.emplace_back(v, v + row + 1, v + row);
    }
  return mesh;
}

void append(RawMesh& mesh, const RawMesh& other) {
  const auto base = unsigned(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (const glm::uvec3& t : other.triangles)
    mesh.triangles.emplace_back(t.x + base, t.y + base, t.z + base);
}

}  // namespace pellucid::stability

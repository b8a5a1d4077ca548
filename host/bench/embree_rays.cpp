// Embree 3: one triangle geometry, medium build quality, single rays.
#include "bench/embree_rays.h"

#include <embree3/rtcore.h>

#include <atomic>
#include <cstring>
#include <limits>
#include <thread>

#include "base/error.h"
#include "base/timer.h"

namespace pellucid {

struct EmbreeRays::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  double build_seconds = 0;
  std::vector<TraceRay> rays;
  std::vector<TraceHit> hits;

  void trace_range(bool any, std::size_t begin, std::size_t end);
};

bool EmbreeRays::available() {
  return true;
}

EmbreeRays::EmbreeRays(const PackedScene& packed, bool robust) : impl_(std::make_unique<Impl>()) {
  impl_->device = rtcNewDevice(nullptr);
  PELLUCID_CHECK(impl_->device != nullptr, "Embree gives no device");
  RTCGeometry mesh = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const std::size_t vertices = packed.positions.size(), triangles = packed.info.triangle_count;
  auto* p = static_cast<float*>(rtcSetNewGeometryBuffer(
      mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices));
  for (std::size_t i = 0; i < vertices; ++i)
    p[3 * i] = packed.positions[i].x, p[3 * i + 1] = packed.positions[i].y,
          p[3 * i + 2] = packed.positions[i].z;
  auto* v = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), triangles));
  for (std::size_t i = 0; i < triangles; ++i)
    v[3 * i] = packed.triangles[i].v0, v[3 * i + 1] = packed.triangles[i].v1,
          v[3 * i + 2] = packed.triangles[i].v2;
  const Timer timer;
  rtcCommitGeometry(mesh);
  impl_->scene = rtcNewScene(impl_->device);
  rtcSetSceneFlags(impl_->scene, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  rtcSetSceneBuildQuality(impl_->scene, RTC_BUILD_QUALITY_MEDIUM);
  rtcAttachGeometry(impl_->scene, mesh);
  rtcCommitScene(impl_->scene);
  impl_->build_seconds = timer.seconds();
  rtcReleaseGeometry(mesh);
}

EmbreeRays::~EmbreeRays() {
  rtcReleaseScene(impl_->scene);
  rtcReleaseDevice(impl_->device);
}

double EmbreeRays::build_seconds() const {
  return impl_->build_seconds;
}

void EmbreeRays::set_rays(const std::vector<TraceRay>& rays) {
  impl_->rays = rays;
  impl_->hits.resize(rays.size());
}

void EmbreeRays::Impl::trace_range(bool any, std::size_t begin, std::size_t end) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (std::size_t i = begin; i < end; ++i) {
    const TraceRay& r = rays[i];
    RTCRayHit q;
    q.ray = {r.ox, r.oy, r.oz, 0.0f, r.dx, r.dy, r.dz, 0.0f, r.t_max, ~0u, 0, 0};
    q.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    if (any) {
      rtcOccluded1(scene, &context, &q.ray);
      hits[i] = {q.ray.tfar, 0, 0, q.ray.tfar < 0.0f ? 0u : NONE};
    } else {
      rtcIntersect1(scene, &context, &q);
      const bool hit = q.hit.geomID != RTC_INVALID_GEOMETRY_ID;
      hits[i] = {q.ray.tfar, q.hit.u, q.hit.v, hit ? q.hit.primID : NONE};
    }
  }
}

double EmbreeRays::trace(bool any, int threads) {
  constexpr std::size_t chunk = 4096;  // rays; small against a run, large against taking one
  std::atomic<std::size_t> next{0};
  const Timer timer;
  std::vector<std::thread> pool;
  for (int t = 0; t < threads; ++t)
    pool.emplace_back([&] {
      for (std::size_t begin; (begin = next.fetch_add(chunk)) < impl_->rays.size();)
        impl_->trace_range(any, begin, std::min(begin + chunk, impl_->rays.size()));
    });
  for (std::thread& thread : pool) thread.join();
  return timer.seconds();
}

std::vector<TraceHit> EmbreeRays::hits() const {
  return impl_->hits;
}

}  // namespace pellucid

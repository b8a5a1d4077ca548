// Interleaved measurement: ours, Embree, ours, Embree robust, ... so that drift hits all alike.
#include "bench/ray_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "base/clock.h"
#include "base/error.h"
#include "base/timer.h"
#include "bench/embree_rays.h"

namespace pellucid {
namespace {

struct Contest {
  RayTracer& ours;
  EmbreeRays* embree;
  EmbreeRays* robust;
  Clock clock;
  int threads;
  int repeats;

  RayCell run(RayKind kind, const std::vector<TraceRay>& rays) const;
};

std::uint64_t count_differences(const std::vector<TraceHit>& a, const std::vector<TraceHit>& b,
                                bool any) {
  std::uint64_t n = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool hit_a = a[i].prim != NONE, hit_b = b[i].prim != NONE;
    // A ray through a shared edge may name either triangle; its distance tells.
    const bool same =
        any || !hit_a || a[i].prim == b[i].prim || std::abs(a[i].t - b[i].t) <= 1e-5f * b[i].t;
    n += hit_a != hit_b || !same;
  }
  return n;
}

RayCell Contest::run(RayKind kind, const std::vector<TraceRay>& rays) const {
  const bool any = wants_any_hit(kind);
  const double million = 1e-6 * double(rays.size());
  ours.set_rays(rays);
  for (EmbreeRays* e : {embree, robust})
    if (e) e->set_rays(rays);
  std::vector<double> own, medium, strict, ratio, ratio_robust;
  const auto time_ours = [&] { return clock([&] { return ours.trace(any); }); };
  for (int i = -1; i < repeats; ++i) {  // the first round warms caches and is not counted
    const double first = time_ours();
    const double m = embree ? clock([&] { return embree->trace(any, threads); }) : 0;
    const double second = time_ours();
    const double r = robust ? clock([&] { return robust->trace(any, threads); }) : 0;
    if (i < 0) continue;
    own.push_back(million / first), own.push_back(million / second);
    // Each Embree run is compared with the mean of its neighbours.
    const double near_own = 0.5 * (first + second);
    if (embree) medium.push_back(million / m), ratio.push_back(m / near_own);
    if (robust) strict.push_back(million / r), ratio_robust.push_back(r / near_own);
  }
  RayCell cell;
  cell.kind = kind;
  cell.mrays_per_s = figure_of(own);
  if (embree) cell.embree_mrays_per_s = figure_of(medium), cell.ratio = figure_of(ratio);
  if (robust) {
    cell.embree_robust_mrays_per_s = figure_of(strict), cell.ratio_robust = figure_of(ratio_robust);
    cell.differing_hits = count_differences(ours.hits(), robust->hits(), any);
  }
  return cell;
}

}  // namespace

RayBench bench_rays(const Device& device, const std::vector<Scene>& scenes,
                    const RayBenchOptions& options) {
  const int cores = std::max(1u, std::thread::hardware_concurrency());
  const int threads = options.threads > 0 ? options.threads : cores;
  RayBench out;
  out.clock = device.info().cpu ? "cpu" : "wall";
  for (const Scene& scene : scenes) {
    if (options.progress) options.progress(scene.name);
    const PackedScene packed = pack_scene(scene, {simd_width_for(device.info())});
    PELLUCID_CHECK(packed.info.triangle_count > 0 && !packed.features.has(FEAT_SPHERES) &&
                       !packed.features.has(FEAT_DISKS),
                   "a ray benchmark scene holds triangles only");
    std::unique_ptr<EmbreeRays> embree, robust;
    if (EmbreeRays::available()) {
      embree = std::make_unique<EmbreeRays>(packed, false);
      robust = std::make_unique<EmbreeRays>(packed, true);
    }
    out.builds.push_back({packed.info.triangle_count, packed.bvh_seconds,
                          embree ? std::optional<double>(embree->build_seconds()) : std::nullopt});
    RayTracer ours(device, packed, options.plan);
    const Contest contest{ours,    embree.get(),   robust.get(), Clock{device.info().cpu, threads},
                          threads, options.repeats};
    for (const auto& [kind, rays] :
         ray_sets(ours, packed, scene.settings.width, scene.settings.height)) {
      if (options.progress)
        options.progress(fmt::format("{}, {}", scene.name, ray_kind_name(kind)));
      out.rays.push_back(contest.run(kind, rays));
      out.rays.back().triangles = packed.info.triangle_count;
    }
  }
  return out;
}

}  // namespace pellucid

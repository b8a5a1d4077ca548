// Ours, naive, naive, ours: a drift of the machine's speed cancels within every turn.
#include "bench/robust_bench.h"

#include <cmath>

#include "bench/bench_scene.h"
#include "bench/ray_sets.h"
#include "render/naive_rays.h"

namespace pellucid {
namespace {

/// Seconds of one run of each.
struct Turn {
  double ours = 0, naive = 0;
};

/// Takes turns and fills in speeds and price; `million` is rays of a run of each.
template <typename Ours, typename Naive>
void take_turns(PriceCell& cell, int repeats, const Turn& million, const Ours& ours,
                const Naive& naive) {
  std::vector<double> own, other, price;
  for (int i = -1; i < repeats; ++i) {  // the first warms caches and is not counted
    Turn turn;
    turn.ours = ours();
    turn.naive = naive() + naive();
    turn.ours += ours();
    if (i < 0) continue;
    own.push_back(2 * million.ours / turn.ours), other.push_back(2 * million.naive / turn.naive);
    price.push_back(turn.ours / turn.naive - 1);
  }
  cell.ours = figure_of(own), cell.naive = figure_of(other), cell.price = median_range(price);
}

std::uint64_t differing_hits(const std::vector<TraceHit>& a, const std::vector<TraceHit>& b,
                             bool any) {
  std::uint64_t n = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool hit_a = a[i].prim != NONE, hit_b = b[i].prim != NONE;
    n += hit_a != hit_b || (!any && hit_a && std::abs(a[i].t - b[i].t) > 1e-3f * a[i].t);
  }
  return n;
}

class Contest {
 public:
  Contest(const Device& device, const Scene& scene, const RobustBenchOptions& options)
      : device_(device),
        scene_(scene),
        options_(options),
        packed_(pack_scene(scene, {simd_width_for(device.info())})),
        clock_{device.info().cpu, device_cores(device.info())},
        naive_plan_(options.plan) {
    naive_plan_.overlay = NAIVE_OVERLAY;
  }

  std::vector<PriceCell> rays() const;
  PriceCell render(const Integrator& method) const;

 private:
  PriceCell cell(const std::string& what) const;

  Device device_;
  const Scene& scene_;
  const RobustBenchOptions& options_;
  PackedScene packed_;
  Clock clock_;
  PlanOptions naive_plan_;
};

PriceCell Contest::cell(const std::string& what) const {
  if (options_.progress) options_.progress(scene_.name + ", " + what);
  PriceCell cell;
  cell.scene = scene_.name;
  cell.triangles = packed_.info.triangle_count;
  cell.what = what;
  return cell;
}

std::vector<PriceCell> Contest::rays() const {
  RayTracer ours(device_, packed_, options_.plan);
  RayTracer naive(device_, for_naive_rays(packed_), naive_plan_);
  std::vector<PriceCell> cells;
  for (const auto& [kind, rays] :
       ray_sets(ours, packed_, scene_.settings.width, scene_.settings.height)) {
    const bool any = wants_any_hit(kind);
    ours.set_rays(rays), naive.set_rays(rays);
    PriceCell c = cell(ray_kind_name(kind));
    const double million = 1e-6 * double(rays.size());
    take_turns(
        c, options_.repeats, {million, million},
        [&] { return clock_([&] { return ours.trace(any); }); },
        [&] { return clock_([&] { return naive.trace(any); }); });
    c.differing = differing_hits(ours.hits(), naive.hits(), any);
    cells.push_back(std::move(c));
  }
  return cells;
}

double mean_of(const std::vector<float>& values) {
  double sum = 0;
  for (float v : values) sum += v;
  return sum / double(values.size());
}

PriceCell Contest::render(const Integrator& method) const {
  constexpr int side = 128;
  constexpr std::uint64_t spp = 16;
  // Naive code is contracted, too.
  PlanOptions fast = naive_plan_;
  fast.float_mode = FloatMode::mad;
  const BenchScene ours(device_, scene_, side, options_.plan);
  const BenchScene naive(device_, scene_, side, fast);
  PriceCell c = cell(method.name);
  const auto run = [&](const BenchScene& scene) {
    return scene.render(method, Sampler::sobol, spp, 0);
  };
  const BenchRun mine = run(ours), theirs = run(naive);
  c.energy = mean_of(theirs.rgb) / mean_of(mine.rgb) - 1;
  take_turns(
      c, options_.repeats, {1e-6 * double(mine.rays), 1e-6 * double(theirs.rays)},
      [&] { return run(ours).seconds; }, [&] { return run(naive).seconds; });
  return c;
}

}  // namespace

std::vector<PriceCell> bench_robustness(const Device& device, const std::vector<Scene>& scenes,
                                        const Integrator& method,
                                        const RobustBenchOptions& options) {
  std::vector<PriceCell> cells;
  for (const Scene& scene : scenes) {
    const Contest contest(device, scene, options);
    for (PriceCell& cell : contest.rays()) cells.push_back(std::move(cell));
    cells.push_back(contest.render(method));
  }
  return cells;
}

}  // namespace pellucid

// The recursion of path weights over long chains of wild densities against sums in log space
// (numerics 7).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "support/test_scenes.h"
#include "support/twin.h"

namespace {

using namespace twin;
using pellucid::test::Random;

constexpr int vertices = 128;

/// One end's view of a chain: vertex 0 is its start, density_a draws each vertex from the one
/// before, and reverse_a from the one after [1/m^2].
struct Chain {
  std::array<double, vertices> density_a, reverse_a;
  std::array<double, vertices> distance2;              ///< of the edge that starts at the vertex
  std::array<double, vertices> cos_leave, cos_arrive;  ///< at the vertex

  /// pdf [1/sr] at vertex i towards i + 1, and back towards i - 1.
  real forward(int i) const { return real(density_a[i + 1] * distance2[i] / cos_arrive[i + 1]); }
  real backward(int i) const {
    return real(reverse_a[i - 1] * distance2[i - 1] / cos_leave[i - 1]);
  }
};

double ten_to(Random& random, double low, double high) {
  return std::pow(10.0, random.uniform(low, high));
}

/// Ratios of the densities from both ends: 10^U(-spread, spread) at every vertex.
Chain random_chain(Random& random, double spread) {
  Chain c;
  for (int i = 0; i < vertices; ++i) {
    c.density_a[i] = ten_to(random, -3, 3);
    c.reverse_a[i] = c.density_a[i] * ten_to(random, -spread, spread);
    c.distance2[i] = ten_to(random, -3, 3);
    c.cos_leave[i] = ten_to(random, -1.5, 0);
    c.cos_arrive[i] = ten_to(random, -1.5, 0);
  }
  return c;
}

/// As the other end sees it.
Chain reversed(const Chain& c) {
  Chain r;
  for (int i = 0; i < vertices; ++i) {
    const int j = vertices - 1 - i;
    r.density_a[i] = c.reverse_a[j];
    r.reverse_a[i] = c.density_a[j];
    r.distance2[i] = j > 0 ? c.distance2[j - 1] : 1.0;
    r.cos_leave[i] = c.cos_arrive[j];
    r.cos_arrive[i] = c.cos_leave[j];
  }
  return r;
}

Launch launch_of(uint heuristic, double merging) {
  Launch launch{};
  launch.mis = heuristic;
  launch.mis_vm = merges ? float(merging) : 0.0f;
  launch.mis_deep = 0.25f;
  return launch;
}

void set_trust(const Launch& launch, Partials& q, bool first, bool direct) {
#ifdef TWIN_MERGE
  q.trust = merge_trust(launch, first, direct);
#endif
}

/// Partials after arriving at each vertex from the second on. The start is drawn the same way by
/// all strategies that draw it, and `hit`: also by chance from the other end.
std::vector<Partials> partials_along(const Launch& launch, const Chain& c, bool hit) {
  bool first = !hit;  // from the camera
  std::vector<Partials> all(vertices);
  Partials q = partials_start(real(1) / c.forward(0),
                              hit ? real(c.cos_leave[0] / c.density_a[0]) / c.forward(0) : real(0));
  for (int i = 1; i < vertices; ++i) {
    partials_arrive(&q, real(c.distance2[i - 1]), real(c.cos_arrive[i]));
    set_trust(launch, q, first, hit && i == 1);
    all[i] = q;
    if (i + 1 < vertices)
      partials_scatter(launch, &q, c.forward(i), c.backward(i), real(c.cos_leave[i]));
    first = false;
  }
  return all;
}

/// Weights of the strategies that draw vertices 0 .. s-1 from the light, then of merging at vertex
/// 2, 3, ..., by sums of logarithms. One end of the chain is the camera, which no walk hits.
std::vector<double> exact_weights(const Launch& launch, const Chain& c) {
  std::vector<double> logs(vertices);
  for (int s = 1; s < vertices; ++s)
    logs[s] = logs[s - 1] + std::log(double(c.density_a[s - 1]) / double(c.reverse_a[s - 1]));
  for (int i = 2; merges && i + 1 < vertices; ++i)
    logs.push_back(logs[i] + std::log(c.density_a[i] * double(launch.mis_vm) *
                                      (i + 2 == vertices ? 1.0 : double(launch.mis_deep))));
  const double most = *std::max_element(logs.begin(), logs.end());
  double sum = 0;
  for (double& x : logs) sum += x = std::exp((launch.mis == MIS_POWER ? 2 : 1) * (x - most));
  for (double& x : logs) x /= sum;
  return logs;
}

struct Errors {
  double worst = 0;
  int chains = 0, bad = 0, not_numbers = 0;
};

/// Weight by the recursion of joining light vertex s - 1 to vertex s.
real joined(const Launch& launch, const Chain& c, int s, const Partials& light,
            const Partials& eye) {
  return partial_weight(launch.mis,
                        partials_end(launch, light, real(c.reverse_a[s - 1]), c.backward(s - 1)),
                        partials_end(launch, eye, real(c.density_a[s]), c.forward(s)));
}

/// The same of merging at vertex i.
real merged(const Launch& launch, const Chain& c, int i, Partials light, const Partials& eye) {
#ifdef TWIN_MERGE
  light.trust = eye.trust;
  return partial_weight(launch.mis, partials_merge(launch, light, c.backward(i)),
                        partials_merge(launch, eye, c.forward(i)));
#else
  return real(0);
#endif
}

Errors errors_of(const Launch& launch, double spread, int chains) {
  Random random(5);
  Errors e;
  for (int n = 0; n < chains; ++n) {
    const Chain light = random_chain(random, spread), eye = reversed(light);
    const std::vector<Partials> from_light = partials_along(launch, light, true),
                                from_eye = partials_along(launch, eye, false);
    const std::vector<double> exact = exact_weights(launch, light);
    double worst = 0;
    const auto compare = [&](real w, double expected) {
      if (!std::isfinite(w)) ++e.not_numbers;
      worst = std::max(worst, std::abs(double(w) - expected));
    };
    for (int s = 2; s + 2 <= vertices; ++s)
      compare(joined(launch, light, s, from_light[s - 1], from_eye[vertices - 1 - s]), exact[s]);
    for (int i = 2; merges && i + 1 < vertices; ++i)
      compare(merged(launch, light, i, from_light[i], from_eye[vertices - 1 - i]),
              exact[vertices + i - 2]);
    e.worst = std::max(e.worst, worst);
    e.bad += worst > 1e-4;
    ++e.chains;
  }
  return e;
}

TEST(AuditPartials, LongChainsOfWildRatios) {
  const std::vector<double> radii = merges ? std::vector{1e-6, 1.0, 1e6} : std::vector{0.0};
  for (uint heuristic : {MIS_BALANCE, MIS_POWER})
    for (double merging : radii)
      for (double spread : {1.0, 3.5, 6.0}) {
        const Errors e = errors_of(launch_of(heuristic, merging), spread, merges ? 1000 : 4000);
        std::printf(
            "%s, merging %g, ratios 10^+-%g: worst error %.2g, %d of %d chains beyond 1e-4\n",
            heuristic == MIS_POWER ? "power" : "balance", merging, spread, e.worst, e.bad,
            e.chains);
        EXPECT_EQ(e.not_numbers, 0);
        EXPECT_LT(e.worst, 1e-4) << e.bad << " of " << e.chains << " chains";
      }
}

// Strategies that cannot draw the way back are gone, however much they weighed before.
TEST(AuditPartials, NoWayBackLeavesWhatEndsHere) {
  const Launch launch = launch_of(MIS_BALANCE, 3);
  for (uint scale : {0u, 1u, 2u, 3u}) {
    Partials q = partials_start(real(2), real(5));
    q.scale = scale;
    set_trust(launch, q, false, false);
    partials_scatter(launch, &q, real(0.5), real(0), real(0.25));
    EXPECT_EQ(double(partials_dVC(q)), (merges ? 2.75 : 2) * 0.25 / 0.5) << scale;
  }
}

}  // namespace

// No ray leaves a closed mesh through an edge or a vertex (numerics 2), on the device.
#include <gtest/gtest.h>

#include <functional>

#include "support/ray_lists.h"

namespace pellucid::test {
namespace {

using Interior = std::function<glm::dvec3(Random&)>;

/// A closed mesh around the origin and random points inside of it.
struct Closed {
  const char* name;
  RawMesh raw;
  Interior inside;
};

Closed sphere() {
  DisplacedSphere shape;
  shape.triangles = 60000;
  return {"sphere", generate(shape), [](Random& random) { return random.in_box(0.2); }};
}

Closed knot() {
  TorusKnot shape;
  shape.triangles = 72000;
  RawMesh raw = generate(shape);
  const double tube = shape.tube * shape.radius;
  const auto inside = [raw, tube](Random& random) {
    const glm::uvec3 t = raw.triangles[random.below(unsigned(raw.triangles.size()))];
    const glm::dvec3 a = raw.positions[t.x], b = raw.positions[t.y], c = raw.positions[t.z];
    const glm::dvec3 n = glm::normalize(glm::cross(b - a, c - a));
    return (a + b + c) / 3.0 - n * (tube * random.uniform(0.3, 1.0));
  };
  return {"knot", std::move(raw), inside};
}

std::vector<TraceRay> aimed(const Closed& closed, const TracedScene& scene,
                            const glm::dvec3& center, bool at_edges) {
  Random random(at_edges ? 1 : 2);
  std::vector<TraceRay> rays(tiered(100000, 1000000));
  for (TraceRay& ray : rays) {
    const uint prim = random.below(scene.packed.info.triangle_count);
    const auto k = int(random.below(3));
    glm::dvec3 target(scene.corner(prim, k));
    if (at_edges) {
      const glm::dvec3 other(scene.corner(prim, (k + 1) % 3));
      target += (other - target) * random.uniform();
    }
    ray = ray_towards(center + closed.inside(random), target);
  }
  return rays;
}

std::size_t misses(const std::vector<TraceHit>& hits) {
  std::size_t n = 0;
  for (const TraceHit& hit : hits) n += hit.prim == NONE;
  return n;
}

void expect_tight(const Closed& closed, double distance, const RayConfig& config) {
  const glm::dvec3 center = distance * glm::dvec3(0.6, -0.64, 0.48);
  Scene scene = empty_scene();
  add_shape(scene, baked(closed.raw, center));
  TracedScene traced(scene, config);
  for (bool at_edges : {true, false}) {
    const std::vector<TraceRay> rays = aimed(closed, traced, center, at_edges);
    const BothHits hits = traced.both(rays);
    const std::size_t closest = misses(hits.closest), any = misses(hits.any);
    const std::string name = std::string("leaks ") + closed.name +
                             " T=" + std::to_string(int(distance)) + " " + name_of(config) +
                             (at_edges ? " edges" : " vertices");
    figure(name, std::to_string(closest) + " closest, " + std::to_string(any) + " any of " +
                     std::to_string(rays.size()));
    EXPECT_EQ(closest, 0u) << name;
    EXPECT_EQ(any, 0u) << name;
  }
  EXPECT_EQ(traced.errors(), 0u);
}

TEST(RayLeaks, SphereAtEveryDistance) {
  const Closed closed = sphere();
  for (double distance : {0.0, 10.0, 1e3, 1e5}) expect_tight(closed, distance, {});
}
TEST(RayLeaks, KnotAtEveryDistance) {
  const Closed closed = knot();
  for (double distance : {0.0, 10.0, 1e3, 1e5}) expect_tight(closed, distance, {});
}
TEST(RayLeaks, SphereInEveryLayout) {
  const Closed closed = sphere();
  for (const RayConfig& config : all_configs()) expect_tight(closed, 0.0, config);
}
TEST(RayLeaks, KnotInEveryLayout) {
  const Closed closed = knot();
  for (const RayConfig& config : all_configs()) expect_tight(closed, 0.0, config);
}

}  // namespace
}  // namespace pellucid::test

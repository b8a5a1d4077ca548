// No light leaks between triangles (numerics 2), and spawned rays do not hit where they start
// (numerics 1).
#include <gtest/gtest.h>

#include "support/test_scenes.h"
#include "support/twin.h"

namespace {

using namespace twin;
using namespace pellucid::test;
using pellucid::Scene;

constexpr int aimed = 100000;

/// Misses among rays from inside a closed lump at distance T from the origin, aimed at vertices
/// (kind 0), at points of edges (1) and at points of faces (2).
int misses(double distance, int kind) {
  Scene scene = empty_scene();
  const glm::dvec3 center = distance * glm::dvec3(0.6, -0.64, 0.48);
  add_shape(scene, lump(2000, center));
  const TwinScene twin(scene);
  Random random(unsigned(kind + 1));
  int missed = 0;
  for (int i = 0; i < aimed; ++i) {
    const Triangle& t = twin.packed.triangles[random.below(twin.packed.info.triangle_count)];
    const real3 v0 = load3(twin.packed.positions[t.v0]), v1 = load3(twin.packed.positions[t.v1]);
    const real3 v2 = load3(twin.packed.positions[t.v2]);
    const real a = real(random.uniform()), b = real(random.uniform());
    real3 target = v0;
    if (kind == 1) target = v0 + (v1 - v0) * a;
    if (kind == 2) target = v0 + ((v1 - v0) * (1 - b) + (v2 - v0) * b) * a;
    const real3 o = to_real3(center + random.in_box(0.2));
    const Hit hit = twin.trace(make_ray(o, normalize3(target - o), REAL_MAX));
    missed += hit.prim == NONE;
  }
  EXPECT_EQ(twin.diag[DIAG_stack_overflow], 0u);
  return missed;
}

TEST(TwinWatertight, AimedAtVertices) {
  for (double distance : {0.0, 10.0, 1e3, 1e5}) EXPECT_EQ(misses(distance, 0), 0) << distance;
}
TEST(TwinWatertight, AimedAtEdges) {
  for (double distance : {0.0, 10.0, 1e3, 1e5}) EXPECT_EQ(misses(distance, 1), 0) << distance;
}
TEST(TwinWatertight, AimedAtFaces) {
  for (double distance : {0.0, 10.0, 1e3, 1e5}) EXPECT_EQ(misses(distance, 2), 0) << distance;
}

TEST(TwinWatertight, RayThroughVertexOfARegularGrid) {
  // Integer coordinates: edge functions are exactly 0 for most of these rays.
  constexpr int side = 16;
  pellucid::RawMesh raw;
  for (int y = 0; y <= side; ++y)
    for (int x = 0; x <= side; ++x) raw.positions.emplace_back(x, y, 0);
  for (unsigned y = 0; y < side; ++y)
    for (unsigned x = 0; x < side; ++x) {
      const unsigned v = y * (side + 1) + x;
      raw.triangles.emplace_back(v, v + 1, v + side + 2);
      raw.triangles.emplace_back(v, v + side + 2, v + side + 1);
    }
  Scene scene = empty_scene();
  add_shape(scene, baked(raw));
  const TwinScene twin(scene);
  for (int y = 1; y < 2 * side; ++y)
    for (int x = 1; x < 2 * side; ++x)
      for (real dz : {real(-1), real(1)})
        for (int slant : {0, 1}) {  // straight down, and along a diagonal of the cells
          const real3 target = REAL3(0.5 * x, 0.5 * y, 0);
          const real3 d = normalize3(REAL3(slant, slant, 4 * dz));
          const real3 o = target - REAL3(slant, slant, 4 * dz);
          EXPECT_NE(twin.trace(make_ray(o, d, REAL_MAX)).prim, NONE) << x << " " << y;
        }
}

/// Rays that leave the surface where another ray hit it, to both sides.
struct Spawned {
  int rays = 0, again = 0;
  double lift = 0;  ///< largest offset relative to the coordinates of the triangle
};

double largest_coordinate(const TwinScene& twin, uint prim) {
  const Triangle& t = twin.packed.triangles[prim];
  real largest = 0;
  for (uint v : {t.v0, t.v1, t.v2})
    largest = r_max(largest, max3(abs3(load3(twin.packed.positions[v]))));
  return double(largest);
}

Spawned spawn_from(const TwinScene& twin, Random& random, int hits, int per_hit, double half) {
  Spawned result;
  for (int i = 0; i < hits; ++i) {
    const Triangle& t = twin.packed.triangles[random.below(twin.packed.info.triangle_count)];
    const real3 v0 = load3(twin.packed.positions[t.v0]), v1 = load3(twin.packed.positions[t.v1]);
    const real3 v2 = load3(twin.packed.positions[t.v2]);
    const real3 b = warp_triangle(real(random.unit24()), real(random.unit24()));
    const real3 target = v0 * b.x + v1 * b.y + v2 * b.z;
    const real3 o = target + to_real3(random.direction()) * real(half * random.uniform(1e-3, 1));
    const real3 away = target - o;
    if (is_black(away)) continue;
    const Ray ray = make_ray(o, normalize3(away), REAL_MAX);
    const Hit hit = twin.trace(ray);
    if (hit.prim == NONE) continue;
    const Surface s = surface_at(&twin.data, ray, hit);
    result.lift = std::max(result.lift, double(s.offset) / largest_coordinate(twin, hit.prim));
    for (int k = 0; k < per_hit; ++k) {
      const glm::dvec3 w = random.direction();
      // A third of them grazes the surface.
      const real3 d = normalize3(
          k % 3 ? to_real3(w) : to_real3(w) - s.ng * (dot3(s.ng, to_real3(w)) * real(0.999)));
      if (dot3(d, s.ng) == 0) continue;
      ++result.rays;
      result.again +=
          twin.trace(make_ray(spawn_origin(s.p, s.ng, s.offset, d), d, REAL_MAX)).prim == hit.prim;
    }
  }
  return result;
}

TEST(TwinSpawn, NoTriangleIsHitAgain) {
  Random random(3);
  const double exponents[][2] = {{-1, 0}, {-3, -1}, {3, 4}, {-2, 4}};
  for (const auto& e : exponents) {
    Scene scene = empty_scene();
    add_shape(scene, scattered(random, 1000, e[0], e[1]));
    const TwinScene twin(scene);
    const Spawned result = spawn_from(twin, random, 12000, is_float ? 21 : 6, std::pow(10.0, e[1]));
    std::printf("sizes and places 10^%g..10^%g: %d rays, %d hit again, lift %.1e\n", e[0], e[1],
                result.rays, result.again, result.lift);
    EXPECT_GT(result.rays, is_float ? 240000 : 60000);
    EXPECT_EQ(result.again, 0);
    EXPECT_LT(result.lift, 64 * 0x1p-24);  // no more than rounding asks for
  }
}

TEST(TwinSpawn, SpheresAreHitAgainOnlyAcross) {
  Random random(4);
  int rays = 0;
  for (double radius : {1e-3, 1.0, 1e3})
    for (double distance : {0.0, 1.0, 1e2, 1e4}) {
      Scene scene = empty_scene();
      const glm::dvec3 c = distance * radius * random.direction();
      add_shape(scene, pellucid::Sphere{c, radius});
      const TwinScene twin(scene);
      for (int i = 0; i < 30000; ++i) {
        const real3 o = to_real3(c + radius * random.uniform(1.1, 10) * random.direction());
        const real3 target = to_real3(c + radius * 0.99 * random.direction());
        const Ray ray = make_ray(o, normalize3(target - o), REAL_MAX);
        const Hit hit = twin.trace(ray);
        if (hit.prim == NONE) continue;
        const Surface s = surface_at(&twin.data, ray, hit);
        const real3 d = to_real3(random.direction());
        const Hit next = twin.trace(make_ray(spawn_origin(s.p, s.ng, s.offset, d), d, REAL_MAX));
        const double cosine = double(dot3(d, s.ng));
        ++rays;
        if (cosine > 0) {
          ASSERT_EQ(next.prim, NONE) << radius << " " << distance << " " << cosine;
        } else if (cosine < -0.01) {
          // Straight through: a chord of 2 r |cos|, shorter by the offset at most.
          ASSERT_NE(next.prim, NONE);
          const double chord = -2 * radius * cosine;
          const double rounding = 64 * 0x1p-24 * radius * (1 + distance) / -cosine;
          ASSERT_NEAR(double(next.t), chord, rounding) << radius << " " << distance;
        }
      }
    }
  EXPECT_GT(rays, 300000);
}

}  // namespace

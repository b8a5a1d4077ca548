// Spawned rays never hit the triangle that they start on (numerics 1), on the device.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/ray_lists.h"

namespace pellucid::test {
namespace {

constexpr std::size_t per_hit = 100;

struct Spawned {
  std::size_t rays = 0, again = 0;
  double lift = 0;  ///< largest offset over the largest coordinate of its triangle
};

double longest_edge(const TracedScene& scene, uint prim) {
  const glm::dvec3 a(scene.corner(prim, 0)), b(scene.corner(prim, 1)), c(scene.corner(prim, 2));
  return std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
}

/// A ray to a random point of a random triangle, from between 0.1 and 100 of its edges away.
TraceRay ray_to_surface(const TracedScene& scene, Random& random) {
  for (;;) {
    const uint prim = random.below(scene.packed.info.triangle_count);
    const double edge = longest_edge(scene, prim);
    if (!(edge > 0)) continue;  // too small for its place: a point
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const glm::dvec3 a(scene.corner(prim, 0)), b(scene.corner(prim, 1)), c(scene.corner(prim, 2));
    const glm::dvec3 target = a + (b - a) * u + (c - a) * v;
    const glm::dvec3 o =
        target + random.direction() * (edge * std::pow(10.0, random.uniform(-1, 2)));
    if (glm::dvec3(glm::vec3(o)) != target) return ray_towards(o, target);
  }
}

/// Directions over both hemispheres; every third grazes the surface.
glm::vec3 spawn_direction(const Start& start, std::size_t k, Random& random) {
  const glm::dvec3 w = random.direction(), n(start.ng);
  return glm::vec3(k % 3 ? w : glm::normalize(w - n * (glm::dot(n, w) * 0.999)));
}

void spawn_batch(TracedScene& scene, Random& random, std::size_t n, Spawned& result) {
  std::vector<TraceRay> first(2 * n / per_hit);
  for (TraceRay& ray : first) ray = ray_to_surface(scene, random);
  const std::vector<TraceHit> hits = scene.closest(first);
  std::vector<TraceRay> rays;
  std::vector<uint> own;
  for (const TraceHit& hit : hits) {
    if (hit.prim == NONE || rays.size() >= n) continue;
    const Start start = start_at(scene, hit);
    float largest = 0;
    for (int k = 0; k < 3; ++k)
      for (int axis = 0; axis < 3; ++axis)
        largest = std::max(largest, std::abs(scene.corner(hit.prim, k)[axis]));
    result.lift = std::max(result.lift, double(start.offset) / largest);
    for (std::size_t k = 0; k < per_hit; ++k) {
      rays.push_back(start.towards(spawn_direction(start, k, random)));
      own.push_back(hit.prim);
    }
  }
  ASSERT_FALSE(rays.empty());
  const std::vector<TraceHit> next = scene.closest(rays);
  result.rays += rays.size();
  for (std::size_t i = 0; i < next.size(); ++i) {
    if (next[i].prim != own[i]) continue;
    if (result.again++ < 3)
      ADD_FAILURE() << "triangle " << own[i] << " again at " << next[i].t << ", o " << rays[i].ox
                    << " " << rays[i].oy << " " << rays[i].oz << ", d " << rays[i].dx << " "
                    << rays[i].dy << " " << rays[i].dz;
  }
}

/// A ninth of all rays: there are nine scenes.
void expect_no_rehits(const std::string& name, Mesh mesh) {
  Scene scene = empty_scene();
  add_shape(scene, std::move(mesh));
  TracedScene traced(scene);
  Random random(7);
  Spawned result;
  const std::size_t wanted = tiered(1000008, 100000008) / 9;
  while (result.rays < wanted && !::testing::Test::HasFatalFailure())
    spawn_batch(traced, random, std::min<std::size_t>(wanted - result.rays, 1000000), result);
  char text[120];
  std::snprintf(text, sizeof text, "%zu of %zu, lift %.1e", result.again, result.rays, result.lift);
  figure("re-hits " + name, text);
  EXPECT_EQ(result.again, 0u) << name;
  EXPECT_EQ(traced.errors(), 0u);
  EXPECT_LT(result.lift, 64 * 0x1p-24);  // no more than rounding asks for
}

Mesh plane(double distance) {
  const glm::dvec3 a = glm::normalize(glm::dvec3(0.8, 0.31, -0.4));
  const glm::dvec3 b = glm::normalize(glm::cross(a, glm::dvec3(0.2, 1.0, 0.3)));
  const glm::dvec3 corner = distance * glm::dvec3(0.6, -0.64, 0.48) - a - b;
  return baked(grid(40, corner, 2.0 * a, 2.0 * b, 2.0));
}

Mesh ball(double distance) {
  DisplacedSphere shape;
  shape.triangles = 5000;
  shape.amplitude = 0;
  return baked(generate(shape), distance * glm::dvec3(0.6, -0.64, 0.48));
}

TEST(RaySpawn, TrianglesOfAllSizesAndPlaces) {
  Random random(1);
  expect_no_rehits("10^U(-8,8)", scattered(random, 400, -8, 8));
}
TEST(RaySpawn, SmallTriangles) {
  Random random(2);
  expect_no_rehits("10^U(-3,-1)", scattered(random, 1000, -3, -1));
}
TEST(RaySpawn, LargeTriangles) {
  Random random(3);
  expect_no_rehits("10^U(3,4)", scattered(random, 1000, 3, 4));
}
TEST(RaySpawn, TiltedPlane) {
  expect_no_rehits("plane T=0", plane(0));
  expect_no_rehits("plane T=1e4", plane(1e4));
}
TEST(RaySpawn, TessellatedSphere) {
  expect_no_rehits("sphere T=0", ball(0));
  expect_no_rehits("sphere T=1e3", ball(1e3));
}
/// The three planes of two axes, each `shift` off the origin: there the error of a point, which
/// follows its coordinates, is far below that of the distance to large triangles.
Mesh axis_planes(double shift) {
  RawMesh raw;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 a(0.0), b(0.0), n(0.0);
    a[(axis + 1) % 3] = b[(axis + 2) % 3] = 1.0;
    n[axis] = shift;
    append(raw, grid(21, n - a - b, 2.0 * a, 2.0 * b));
  }
  return baked(raw);
}

TEST(RaySpawn, AxisAlignedPlanesThroughTheOrigin) {
  expect_no_rehits("axis planes", axis_planes(0));
  expect_no_rehits("axis planes 1e-3 off", axis_planes(1e-3));
}

}  // namespace
}  // namespace pellucid::test

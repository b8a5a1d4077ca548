// Spheres from afar and disks (numerics 29).
#include <gtest/gtest.h>

#include "support/test_scenes.h"
#include "support/twin.h"

namespace {

using namespace twin;
using namespace pellucid::test;

constexpr double pi_d = 3.14159265358979323846;

TEST(TwinQuadric, SphereFromAfar) {
  Random random(1);
  const F4 sphere{0, 0, 0, 1};
  for (double distance = 1.5; distance <= 1e6; distance *= 3) {
    double worst = 0;
    for (int i = 0; i < 50000; ++i) {
      const glm::dvec3 view = random.direction();
      const real3 o = to_real3(distance * view);
      const real3 target = to_real3(0.9 * random.direction());
      const Ray ray = make_ray(o, normalize3(target - o), REAL_MAX);
      const real t = sphere_hit(sphere, ray);
      // From 1e6 radii a float direction is no better than a twentieth of the radius.
      if (is_float && distance > 1e5 && t < 0) continue;
      ASSERT_GT(double(t), 0.0) << distance;
      Surface s;
      sphere_point(sphere, normalize3(ray.o + ray.d * t), &s);
      worst = std::max(worst, std::abs(glm::length(to_dvec3(s.p)) - 1));
      const double error = std::abs(glm::length(to_dvec3(ray.o) + to_dvec3(ray.d) * double(t)) - 1);
      const double roundoff = is_float ? 0x1p-24 : 0x1p-53;
      ASSERT_LT(error, 32 * roundoff * (1 + distance));  // t itself has ulps of the distance
    }
    EXPECT_LT(worst, 1e-5) << distance;
  }
}

TEST(TwinQuadric, SilhouetteFromAfar) {
  Random random(2);
  const F4 sphere{0, 0, 0, 1};
  for (double distance : {2.0, 1e2, 1e4, 1e6}) {
    // Parallel rays across a square of 3 x 3: the share of hits is pi / 9.
    constexpr int n = 1000;
    int hits = 0;
    const glm::dvec3 d = random.direction();
    const Frame frame = frame_from_normal(to_real3(d));
    const glm::dvec3 s = to_dvec3(frame.s), t = to_dvec3(frame.t), m = to_dvec3(frame.n);
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) {
        const glm::dvec3 o =
            (3 * (i + 0.5) / n - 1.5) * s + (3 * (k + 0.5) / n - 1.5) * t - distance * m;
        hits += sphere_hit(sphere, make_ray(to_real3(o), frame.n, REAL_MAX)) > 0;
      }
    // 0.1 %, and at 1e6 half an ulp of the origin (1/32) that moves rays in and out.
    const double tolerance = is_float && distance > 1e5 ? 0.01 : 1e-3;
    EXPECT_NEAR(9.0 * hits / (double(n) * n) / pi_d, 1.0, tolerance) << distance;
  }
}

TEST(TwinQuadric, SphereFromInside) {
  Random random(3);
  const F4 sphere{1, 2, 3, 2};
  for (int i = 0; i < 100000; ++i) {
    const glm::dvec3 o = glm::dvec3(1, 2, 3) + 1.99 * random.uniform() * random.direction();
    const Ray ray = make_ray(to_real3(o), to_real3(random.direction()), REAL_MAX);
    const real t = sphere_hit(sphere, ray);
    ASSERT_GT(double(t), 0.0);
    const glm::dvec3 p = to_dvec3(ray.o) + to_dvec3(ray.d) * double(t);
    ASSERT_NEAR(glm::length(p - glm::dvec3(1, 2, 3)), 2.0, 4e-6);
  }
}

TEST(TwinQuadric, SphereRespectsTheEndOfTheRay) {
  const F4 sphere{0, 0, 0, 1};
  const Ray ray = make_ray(REAL3(0, 0, -3), REAL3(0, 0, 1), REAL_MAX);
  EXPECT_EQ(double(sphere_hit(sphere, ray)), 2.0);
  EXPECT_EQ(double(sphere_hit(sphere, make_ray(ray.o, ray.d, 2))), 2.0);
  EXPECT_LT(double(sphere_hit(sphere, make_ray(ray.o, ray.d, real(1.999)))), 0.0);
  EXPECT_LT(double(sphere_hit(sphere, make_ray(ray.o, -ray.d, REAL_MAX))), 0.0);
  EXPECT_LT(double(sphere_hit(sphere, make_ray(REAL3(2, 0, -3), ray.d, REAL_MAX))), 0.0);
}

TEST(TwinQuadric, DiskShowsItsEllipse) {
  Random random(4);
  for (double cosine : {1.0, 0.5, 0.05}) {
    constexpr int n = 1000;
    const F4 center_radius{0, 0, 0, 1};
    const F4 normal{float(std::sqrt(1 - cosine * cosine)), 0, float(cosine), 0};
    int hits = 0;
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) {
        const real3 o = REAL3(3 * (i + 0.5) / n - 1.5, 3 * (k + 0.5) / n - 1.5, 50);
        const real t = disk_hit(center_radius, normal, make_ray(o, REAL3(0, 0, -1), REAL_MAX));
        hits += t > 0;
      }
    EXPECT_NEAR(9.0 * hits / (double(n) * n), pi_d * cosine, 0.003) << cosine;  // border cells
  }
  EXPECT_LT(double(disk_hit({0, 0, 0, 1}, {0, 0, 1, 0},
                            make_ray(REAL3(0, 0, 0), REAL3(1, 0, 0), REAL_MAX))),
            0.0)
      << "a ray in its plane";
}

TEST(TwinQuadric, DiskPointLiesOnItsPlane) {
  Random random(5);
  for (int i = 0; i < 100000; ++i) {
    const glm::dvec3 n = random.direction(), c = random.in_box(10);
    pellucid::Scene unused;
    Quadric q{{float(c.x), float(c.y), float(c.z), 2},
              {float(n.x), float(n.y), float(n.z), 0},
              {},
              QUADRIC_DISK,
              0,
              0,
              0};
    const real3 o = to_real3(c + random.in_box(20));
    const real3 target = to_real3(c);
    const Ray ray = make_ray(o, normalize3(target - o), REAL_MAX);
    const real t = disk_hit(q.center_radius, q.normal, ray);
    if (t < 0) continue;
    Surface s;
    disk_point(q, ray.o + ray.d * t, &s);
    const glm::dvec3 exact_n(q.normal.x, q.normal.y, q.normal.z);
    const glm::dvec3 exact_c(q.center_radius.x, q.center_radius.y, q.center_radius.z);
    ASSERT_LE(std::abs(glm::dot(to_dvec3(s.p) - exact_c, exact_n)), double(s.offset));
  }
}

}  // namespace

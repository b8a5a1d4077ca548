// Frames (numerics 33) and the maps from the unit square.
#include <gtest/gtest.h>

#include "support/statistics.h"
#include "support/test_scenes.h"
#include "support/twin.h"

namespace {

using namespace twin;
using namespace pellucid::test;

constexpr double pi_d = 3.14159265358979323846;

/// Largest deviation of the frame of n from a right-handed orthonormal one, in double.
double frame_error(real3 n) {
  const Frame f = frame_from_normal(n);
  const glm::dvec3 s = to_dvec3(f.s), t = to_dvec3(f.t), m = to_dvec3(f.n);
  const glm::dvec3 hand = glm::cross(s, t) - m;
  return std::max({std::abs(glm::dot(s, t)), std::abs(glm::dot(s, m)), std::abs(glm::dot(t, m)),
                   std::abs(glm::length(s) - 1), std::abs(glm::length(t) - 1), glm::length(hand)});
}

/// 2^24 normals on a 4096 x 4096 octahedral grid would take too long; every seventh of them.
TEST(TwinFrame, OrthonormalForQuantisedNormals) {
  constexpr int grid = 4096;
  double worst = 0;
  for (int i = 0; i < grid * grid; i += 7) {
    const double x = (2.0 * (i % grid) + 1) / grid - 1, y = (2.0 * int(i / grid) + 1) / grid - 1;
    glm::dvec3 n(x, y, 1 - std::abs(x) - std::abs(y));
    if (n.z < 0) {
      const double fold_x = (1 - std::abs(y)) * (x < 0 ? -1 : 1);
      n.y = (1 - std::abs(x)) * (y < 0 ? -1 : 1);
      n.x = fold_x;
    }
    worst = std::max(worst, frame_error(to_real3(glm::normalize(n))));
  }
  std::printf("frames: worst deviation %.2e\n", worst);
  EXPECT_LT(worst, 2e-7);
}

TEST(TwinFrame, NearMinusZ) {
  Random random(4);
  for (int i = 0; i < 200000; ++i) {
    const double sine = std::pow(10.0, random.uniform(-20, -1)), phi = random.uniform(0, 2 * pi_d);
    for (double sign : {-1.0, 1.0}) {
      const glm::dvec3 n(sine * std::cos(phi), sine * std::sin(phi),
                         sign * std::sqrt(1 - sine * sine));
      ASSERT_LT(frame_error(to_real3(n)), 2e-7) << n.x << " " << n.y << " " << n.z;
    }
  }
  for (real z : {real(1), real(-1)}) EXPECT_EQ(frame_error(REAL3(0, 0, z)), 0.0);
  for (real z : {real(0), real(-0.0), real(1e-30), real(-1e-30)}) {
    EXPECT_LT(frame_error(REAL3(1, 0, z)), 2e-7);
    EXPECT_LT(frame_error(REAL3(0, -1, z)), 2e-7);
  }
}

TEST(TwinFrame, DirectionsDoNotDrift) {
  // 1000 bounces with one normalisation each, as vertex_sample does it.
  Random random(5);
  real3 w = to_real3(random.direction());
  for (int i = 0; i < 1000; ++i) {
    const Frame f = frame_from_normal(to_real3(random.direction()));
    const real3 local = to_local(f, w);
    w = normalize3(to_world(f, REAL3(-local.x, -local.y, local.z)));
    ASSERT_NEAR(double(length3(w)), 1.0, 1e-6);
  }
}

struct Warp {
  const char* name;
  real3 (*map)(real u, real v);
  double (*density)(const glm::dvec3& w);
};

const Warp warps[] = {
    {"cosine hemisphere", warp_cosine_hemisphere,
     [](const glm::dvec3& w) { return w.z > 0 ? w.z / pi_d : 0.0; }},
    {"hemisphere", warp_hemisphere, [](const glm::dvec3& w) { return w.z > 0 ? 0.5 / pi_d : 0.0; }},
    {"sphere", warp_sphere, [](const glm::dvec3&) { return 0.25 / pi_d; }},
};

TEST(TwinWarp, DirectionsFollowTheirDensity) {
  constexpr int n = 1000000;
  for (const Warp& warp : warps) {
    Random random(6);
    const LobeGrid grid(glm::dvec3(0, 0, 1), 1.0);  // the horizon is a border of cells
    std::vector<double> expected = grid.integrate_cells(warp.density, 1e-9);
    std::vector<double> observed(expected.size(), 0.0);
    for (double& e : expected) e *= n;
    for (int i = 0; i < n; ++i) {
      const real3 w = warp.map(real(random.unit24()), real(random.unit24()));
      ASSERT_NEAR(double(dot3(w, w)), 1.0, 1e-6) << warp.name;
      ++observed[size_t(grid.cell(to_dvec3(w)))];
    }
    const ChiSquare test = chi_square(observed, expected);
    EXPECT_TRUE(accepted(test, sidak(family_alpha, int(std::size(warps)))))
        << warp.name << ": " << test.describe();
  }
}

TEST(TwinWarp, DiskAndTriangleAreUniform) {
  constexpr int n = 1000000, side = 16;
  Random random(7);
  std::vector<double> disk(side * side, 0.0), triangle(side * side, 0.0);
  for (int i = 0; i < n; ++i) {
    const real u = real(random.unit24()), v = real(random.unit24());
    const glm::dvec3 d = to_dvec3(warp_disk(u, v));
    const double r2 = d.x * d.x + d.y * d.y, phi = std::atan2(d.y, d.x) / (2 * pi_d) + 0.5;
    ++disk[size_t(std::min(int(r2 * side), side - 1) * side + std::min(int(phi * side), side - 1))];
    const glm::dvec3 b = to_dvec3(warp_triangle(u, v));
    ASSERT_NEAR(b.x + b.y + b.z, 1.0, 2e-7);
    // Cells of equal area: strips parallel to an edge by (1 - b0)^2, then along the strip.
    const double strip = (1 - b.x) * (1 - b.x), along = b.z / std::max(1 - b.x, 1e-12);
    ++triangle[size_t(std::min(int(strip * side), side - 1) * side +
                      std::min(int(along * side), side - 1))];
  }
  const std::vector<double> expected(side * side, double(n) / (side * side));
  const double alpha = sidak(family_alpha, 2);
  EXPECT_TRUE(accepted(chi_square(disk, expected), alpha)) << chi_square(disk, expected).describe();
  EXPECT_TRUE(accepted(chi_square(triangle, expected), alpha))
      << chi_square(triangle, expected).describe();
}

TEST(TwinWarp, FiniteAtTheEnds) {
  const real ends[] = {0, real(0x1p-24), real(0.5), real(1 - 0x1p-24)};
  for (real u : ends)
    for (real v : ends)
      for (real3 w : {warp_cosine_hemisphere(u, v), warp_hemisphere(u, v), warp_sphere(u, v),
                      warp_disk(u, v), warp_triangle(u, v)}) {
        EXPECT_TRUE(is_finite(w.x) && is_finite(w.y) && is_finite(w.z)) << u << " " << v;
        EXPECT_LE(double(dot3(w, w)), 1 + 1e-6);
      }
}

}  // namespace

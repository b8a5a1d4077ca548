// The gap test (numerics 1): how close may a facing plane lie before a spawned ray starts beyond
// it?
#ifdef PELLUCID_REAL_IS_FLOAT  // ulps of float: there is nothing to ask of the double twin
#include <gtest/gtest.h>

#include <algorithm>

#include "support/test_scenes.h"
#include "support/twin.h"

namespace {

using namespace twin;
using namespace pellucid::test;

/// Two facing planes around the point at distance P, of triangles about `cell` P wide.
struct Case {
  const char* name;
  glm::dvec3 place, normal;  ///< unit
};
const Case cases[] = {
    {"axis plane, on its axis", {0, 0, 1}, {0, 0, 1}},
    {"axis plane, off its axis", {0.6, -0.48, 0.64}, {0, 0, -1}},
    {"tilted, facing the origin", {0.6, -0.64, 0.48}, {0.6, -0.64, 0.48}},
    {"tilted, seen edge-on", {0.6, -0.64, 0.48}, {0.8, 0.48, -0.36}},
    {"tilted at random", {0.6, -0.64, 0.48}, {0.36, 0.48, 0.8}},
};
constexpr int cells = 6;  ///< along a side

/// A square of cells x cells cells, each two triangles, around `center`; the outermost are four
/// times as wide, so that no ray leaves past the border.
pellucid::RawMesh sheet(const glm::dvec3& center, const glm::dvec3& n, double cell) {
  const glm::dvec3 pick = std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 a = glm::normalize(glm::cross(n, pick)), b = glm::cross(n, a);
  pellucid::RawMesh raw;
  const auto place = [&](int i) {
    const double x = (i - 0.5 * cells) * cell;
    return i == 0 ? x - 3 * cell : i == cells ? x + 3 * cell : x;
  };
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) raw.positions.push_back(center + place(i) * a + place(j) * b);
  constexpr unsigned row = cells + 1;
  for (unsigned j = 0; j < cells; ++j)
    for (unsigned i = 0; i < cells; ++i) {
      const unsigned v = j * row + i;
      raw.triangles.emplace_back(v, v + 1, v + row + 1);
      raw.triangles.emplace_back(v, v + row + 1, v + row);
    }
  return raw;
}

/// Rays from plane A towards B, `gap` away, that do not hit B.
int leaks(const Case& c, double P, double cell, double gap, int rays) {
  const glm::dvec3 center = P * c.place;
  pellucid::Scene scene = empty_scene();
  add_shape(scene, baked(sheet(center, c.normal, cell * P)));
  const TwinScene alone(scene);
  add_shape(scene, baked(sheet(center + gap * c.normal, c.normal, cell * P)));
  const TwinScene both(scene);
  Random random(1);
  int lost = 0;
  for (int i = 0; i < rays; ++i) {
    // Onto A from behind; B is away then.
    const glm::dvec3 up = c.normal, side = random.direction();
    const glm::dvec3 target = center + cell * P * (side - up * glm::dot(up, side));
    const real3 o = to_real3(target - cell * P * (up + 0.5 * random.direction()));
    const Ray ray = make_ray(o, normalize3(to_real3(target) - o), REAL_MAX);
    const Hit hit = alone.trace(ray);
    if (hit.prim == NONE) continue;
    const Surface s = surface_at(&both.data, ray, hit);
    glm::dvec3 w = random.direction();
    const double cosine = glm::dot(w, up);
    if (cosine < 0) w -= 2 * cosine * up;
    if (std::abs(cosine) < 0.05) continue;
    const real3 d = to_real3(w);
    const Hit next = both.trace(make_ray(spawn_origin(s.p, s.ng, s.offset, d), d, REAL_MAX));
    lost += next.prim == NONE || next.prim < alone.packed.info.triangle_count;
  }
  return lost;
}

double ulp(double x) {
  return double(std::nextafter(float(x), 3e38f)) - double(float(x));
}

/// Smallest gap, in ulps of P, from which on nothing leaks.
double smallest_gap(const Case& c, double P, double cell) {
  double smallest = 512;
  for (double g : {384., 256., 192., 128., 96., 64., 48., 32., 24., 16., 12., 8., 6., 4., 2.}) {
    if (leaks(c, P, cell, g * ulp(P), 3000) > 0) return smallest;
    smallest = g;
  }
  return smallest;
}

TEST(TwinGap, FacingPlanesWithin64Ulps) {
  for (const Case& c : cases)
    for (double P : {0.1, 1.0, 1e3, 1e6})
      for (double cell : {1e-3, 0.03, 0.3}) {
        const double g = smallest_gap(c, P, cell);
        std::printf("gap, %s, P %g, triangles of %g P: g_min %g ulp(P)\n", c.name, P, cell, g);
        EXPECT_LE(g, 64) << c.name << ", P " << P << ", cell " << cell;
      }
}

}  // namespace

#endif

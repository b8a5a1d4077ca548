// CF1 by merging: in a closed room of flat facets that glow, photons come from a ball cut out of a
// bent surface instead of a disc, and what they bring is known exactly.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include "equality.h"
#include "render_harness.h"
#include "shared/limits.h"
#include "support/facets.h"
#include "support/statistics.h"

namespace pellucid::test {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr std::array<double, 2> radii{0.05, 0.02};
constexpr std::uint64_t first_seed = 500;
constexpr uint light_paths = 1 << 13;

/// What a vertex on one facet gathers from photons on another, their planes `angle` apart, over
/// what it gathers in the plane where merges are alone. The light is the same from everywhere, and
/// what comes from above both planes counts. A merge at the eye's vertex x weighs 1 / (1 + others
/// cos_x / cos_y) against strategies whose densities add up to `others` in the plane: their cosine
/// is that at x, that of the photon at y. So of all directions about their common edge
///   1/2 integral of cos_y^2 / (cos_y + others cos_x), cos_x = cos(t - angle), cos_y = cos t.
/// The denominator is scale cos(t - turn).
double brought(double angle, double others) {
  const double x = 1 + others * std::cos(angle), y = others * std::sin(angle);
  const double scale = std::hypot(x, y), turn = std::atan2(y, x);
  const auto primitive = [&](double t) {
    return std::sin(t + turn) + std::pow(std::sin(turn), 2) * std::asinh(std::tan(t - turn));
  };
  if (y == 0)  // where tan has its poles at the ends of the lune
    return (1 + std::cos(angle)) / (2 * scale);
  return (primitive(pi / 2) - primitive(angle - pi / 2)) / (2 * scale);
}

/// What is found in balls around points: area by the angle of its plane, over that of the disc.
struct Balls {
  static constexpr double step = pi / 720;
  std::vector<double> area_at = std::vector<double>(721);  ///< [angle / step], sum over points
  Moments area, light;  ///< of a point: all area, and what it gathers where merges are alone

  void add(const std::vector<Facet>& facets, const FacetHit& point, double radius) {
    double found = 0, gathered = 0;
    for (const Facet& f : facets) {
      const double cosine = std::min(glm::dot(f.normal, point.facet->normal), 1.0);
      if (cosine < MERGE_COS_MIN) continue;
      const double part = area_in_ball(f, point.at, radius) / (pi * radius * radius);
      if (part == 0) continue;
      found += part;
      gathered += part * (1 + cosine) / 2;
      area_at[std::size_t(std::lround(std::acos(cosine) / step))] += part;
    }
    area.add(found);
    light.add(gathered);
  }

  double mean_brought(double others) const {
    double sum = 0;
    for (std::size_t i = 0; i < area_at.size(); ++i)
      if (area_at[i] > 0) sum += area_at[i] * brought(double(i) * step, others);
    return sum / double(area.n);
  }
};

constexpr int strata = 128;  // a side of the picture: standard errors of some 3e-4

struct Furnace {
  Scene scene = scene_named("furnace");
  Rgb rho = scene.materials.at(0).reflectance;
  std::vector<Facet> facets = facets_of(std::get<Mesh>(scene.shapes.at(0).geometry));
  double area = 0;
  /// [radius][bounces so far] around the vertices of eye paths; after a few bounces they are
  /// anywhere.
  std::array<std::array<Balls, 4>, radii.size()> balls;

  Furnace() {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (const Facet& f : facets) area += f.area;
    const double half = std::tan(scene.camera.fov / 2 * pi / 180);
    for (int i = 0; i < strata * strata; ++i) {
      const double x = 2 * (i % strata + uniform(random)) / strata - 1;
      const double y = 2 * (i / strata + uniform(random)) / strata - 1;
      glm::dvec3 origin = scene.camera.origin;
      glm::dvec3 direction =
          scene.camera.forward + half * (x * scene.camera.right + y * scene.camera.up);
      for (std::size_t bounces = 0; bounces < balls[0].size(); ++bounces) {
        const FacetHit hit = first_hit(facets, origin, direction);
        if (!hit.facet) break;  // between two facets, by rounding; tested below
        for (std::size_t r = 0; r < radii.size(); ++r) balls[r][bounces].add(facets, hit, radii[r]);
        // Lambert: the normal and a point of the unit sphere. Rays start off the wall.
        const double z = 2 * uniform(random) - 1, turn = 2 * pi * uniform(random);
        const double s = std::sqrt(1 - z * z);
        direction = hit.facet->normal + glm::dvec3(s * std::cos(turn), s * std::sin(turn), z);
        origin = hit.at + 1e-9 * hit.facet->normal;
      }
    }
  }

  /// 4 standard errors of what balls hold, the largest. Weights below 1 leave less of it.
  double slack(std::size_t radius, std::size_t vertices) const {
    double worst = 0;
    for (std::size_t i = 0; i < vertices; ++i) {
      const Balls& b = balls[radius][i];
      worst = std::max({worst, b.area.standard_error(), b.light.standard_error()});
    }
    return 4 * worst;
  }
};

const Furnace& furnace() {
  static const Furnace f;
  return f;
}

/// `bpm`: light that has been scattered n times is found by chance or by a merge at one of its
/// vertices. Densities of Lambert's walks from either end differ by constants alone, so that a
/// merge weighs 1 at the first vertex and MERGE_DEEP_TRUST elsewhere, chance `by_chance` (a
/// scattering more, but a starting point on the walls less); each merge finds `brought`.
double bpm_radiance(const Furnace& f, std::size_t radius, double rho) {
  constexpr int longest = 80;  // 0.8^80 < 2e-8
  const double disc = pi * radii[radius] * radii[radius];
  const double survive = std::max({f.rho.x, f.rho.y, f.rho.z});
  const double by_chance = survive * f.area / (light_paths * disc);
  const auto trust = [](int n) { return 1 + (n - 1) * double(MERGE_DEEP_TRUST); };
  double sum = 0;
  for (int n = 0; n <= longest; ++n) {
    double found = n ? by_chance / (trust(n) + by_chance) : 1;
    for (int at = 1; at <= n; ++at) {
      const Balls& b = f.balls[radius][std::min<std::size_t>(std::size_t(at), 4) - 1];
      const double own = at > 1 ? double(MERGE_DEEP_TRUST) : 1;
      const double others = (trust(n) - trust(at) + by_chance) / trust(at);
      found += own / trust(at) * b.mean_brought(others);
    }
    sum += (1 - rho) * std::pow(rho, n) * found;
  }
  return sum;
}

/// Means of the picture of each channel in runs: all light, and what merges bring of it.
struct Found {
  std::array<Sample, 3> all, merged;
};

/// `apart`: for methods that merge only what light samples do not bring.
Found find(const char* method, int size, std::size_t radius, int passes_of_run, bool apart) {
  constexpr int runs = 32;
  const auto passes = std::uint64_t(passes_of_run * tier_effort());
  Build b{method, size, size};
  b.light_paths = light_paths;
  b.radius = radii[radius], b.radius_alpha = 1;
  Renderer renderer(furnace().scene, b);
  Found found;
  for (std::uint64_t k = 0; k < runs; ++k) {
    const Picture picture = renderer.render({passes, first_seed + k, {}, MIS_BALANCE});
    for (int c = 0; c < 3; ++c) found.all[std::size_t(c)].push_back(picture.image(c).mean);
    if (!apart) continue;
    // By the same random numbers all but the merges.
    const Picture direct = renderer.render({passes, first_seed + k, 2u, MIS_BALANCE});
    for (int c = 0; c < 3; ++c)
      found.merged[std::size_t(c)].push_back(picture.image(c).mean - direct.image(c).mean);
  }
  return found;
}

/// And says which.
std::string print(const char* method, std::size_t radius, int channel, const Estimate& e,
                  double expected) {
  const std::string what = fmt::format("{}, radius {}, channel {}", method, radii[radius], channel);
  fmt::print("{}: {:.5f} +- {:.5f}, expected {:.5f}\n", what, e.mean, e.error(), expected);
  return what;
}

TEST(FurnaceMerge, area_in_ball_is_that_of_circle_sector_and_facet) {
  const double r = 0.3, disc = pi * r * r;
  const glm::dvec3 up{0, 0, 1};
  const auto facet = [&](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    return Facet{a, b, c, up, 0.5 * glm::length(glm::cross(b - a, c - a))};
  };
  const Facet wide = facet({-1, -1, 0}, {3, -1, 0}, {-1, 3, 0});
  const auto area = [&](const glm::dvec3& at) { return area_in_ball(wide, at, r); };
  EXPECT_NEAR(area({0, 0, 0}), disc, 1e-14) << "circle inside";
  EXPECT_NEAR(area({0.1, 0, -0.2}), pi * (r * r - 0.04), 1e-14) << "off the plane";
  EXPECT_NEAR(area({1, -1, 0}), disc / 2, 1e-14) << "half a plane";
  EXPECT_NEAR(area({-1, -1, 0}), disc / 4, 1e-14) << "a corner";
  const double angle = std::acos(0.1 / r), cap = r * r * angle - 0.1 * std::sqrt(r * r - 0.01);
  EXPECT_NEAR(area({1, -1.1, 0}), cap, 1e-14) << "a segment";
  EXPECT_NEAR(area({1, -0.9, 0}), disc - cap, 1e-14) << "all but a segment";
  EXPECT_NEAR(area({1, -1.4, 0}), 0, 1e-14) << "beside it";
  EXPECT_EQ(area({0, 0, r}), 0) << "above it";
  const Facet small = facet({0.1, 0, 0}, {0.2, 0, 0}, {0, 0.1, 0});
  EXPECT_NEAR(area_in_ball(small, {0, 0, 0.1}, r), small.area, 1e-15) << "facet inside";
}

TEST(FurnaceMerge, walks_of_the_judge_stay_inside) {
  for (const auto& of_radius : furnace().balls)
    for (const Balls& b : of_radius) EXPECT_EQ(b.area.n, std::uint64_t(strata * strata));
}

// The closed form against its integral, which changes quickly at its ends; with no others, the lune
// that two hemispheres share.
TEST(FurnaceMerge, light_above_two_planes) {
  for (double angle : {0.01, 0.3, 1.0})
    for (double others : {0.0, 0.2, 1.0, 30.0}) {
      const auto at = [&](double t, double) {
        return std::pow(std::cos(t), 2) / (std::cos(t) + others * std::cos(t - angle));
      };
      const double sum = integrate(at, angle - pi / 2, pi / 2, 0, 1, 1e-9) / 2;
      EXPECT_NEAR(brought(angle, others), sum, 1e-6) << angle << " " << others;
    }
  EXPECT_NEAR(brought(0.3, 0), (1 + std::cos(0.3)) / 2, 1e-15);
  EXPECT_NEAR(brought(0, 3), 0.25, 1e-15);
}

// Light samples bring what comes straight from a wall; merges the rest, rho of all light, of which
// rho is seen: rho^2 times what balls find. That is less than in a plane, 1, and would be more
// without lunes; the noise lets neither pass for it.
TEST(FurnaceMerge, sppm_gathers_what_balls_hold) {
  const Furnace& f = furnace();
  for (std::size_t r = 0; r < radii.size(); ++r) {
    const Balls& seen = f.balls[r][0];
    const double slack = f.slack(r, 1), light = seen.light.mean;
    const Found found = find("sppm", 48, r, 8, true);
    for (int c = 0; c < 3; ++c) {
      const double again = f.rho[c] * f.rho[c];
      Estimate merged = estimate(found.merged[std::size_t(c)]);
      merged.mean /= again, merged.variance /= again * again;
      const std::string what = print("sppm", r, c, merged, light);
      EXPECT_EQ(judge(merged, light, slack), "") << what;
      const double width = 4.5 * merged.error() + slack;
      EXPECT_LT(width, seen.area.mean - light) << what << ": lunes do not show";
      if (r == 0) {
        EXPECT_LT(width, 1 - light) << what << ": looks like a plane";
      }
    }
  }
}

// Its weights add up to 1 in planes alone: at edges more is found than there is where merges have
// little weight, as they do at the smaller radius.
TEST(FurnaceMerge, bpm_finds_what_its_weights_leave) {
  const Furnace& f = furnace();
  for (std::size_t r = 0; r < radii.size(); ++r) {
    const Found found = find("bpm", 24, r, 8, false);
    for (int c = 0; c < 3; ++c) {
      const double expected = bpm_radiance(f, r, f.rho[c]);
      const Estimate all = estimate(found.all[std::size_t(c)]);
      const std::string what = print("bpm", r, c, all, expected);
      EXPECT_EQ(judge(all, expected, f.rho[c] * f.slack(r, 4)), "") << what;
    }
  }
}

// Densities of connections do not cancel, and no more is known than this: they and light samples
// take from merges, which are off by so much alone.
TEST(FurnaceMerge, vcm_is_off_by_less_than_merges) {
  const Furnace& f = furnace();
  for (std::size_t r = 0; r < radii.size(); ++r) {
    const Found found = find("vcm", 24, r, 4, false);
    for (int c = 0; c < 3; ++c) {
      const double off = f.rho[c] * f.rho[c] * (1 - f.balls[r][0].light.mean);
      const Estimate all = estimate(found.all[std::size_t(c)]);
      const std::string what = print("vcm", r, c, all, 1);
      EXPECT_NEAR(all.mean, 1, 4.5 * all.error() + off) << what;
      EXPECT_LT(4.5 * all.error(), tier_tolerance() / 2) << what << ": too noisy";
    }
  }
}

}  // namespace
}  // namespace pellucid::test

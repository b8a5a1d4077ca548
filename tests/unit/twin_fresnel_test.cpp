// Known values of Fresnel and GGX terms (numerics CF9, CF17).
#include <gtest/gtest.h>

#include "support/bsdf_cases.h"
#include "support/statistics.h"
#include "support/twin.h"

namespace {

using namespace twin;
using namespace pellucid::test;

constexpr double pi_d = 3.14159265358979323846;
/// The arithmetic of `real` on values near 1.
constexpr double roundoff = is_float ? 1e-6 : 1e-9;

double dielectric(double cosine, double eta) {
  real cos_t;
  return double(fresnel_dielectric(real(cosine), real(eta), &cos_t));
}

/// Mean of f(cosine) over a hemisphere weighted by the cosine.
double cosine_mean(const std::function<double(double)>& f) {
  // Many pieces, since refinement has a limit and the critical angle a square root.
  constexpr int pieces = 1024;
  double sum = 0;
  for (int i = 0; i < pieces; ++i)
    sum += integrate([&](double c, double) { return 2 * c * f(c); }, double(i) / pieces,
                     (i + 1.0) / pieces, 0, 1, 1e-9);
  return sum;
}

TEST(TwinFresnel, NormalIncidence) {
  for (double n : {1.0001, 1.33, 1.5, 2.4, 10.0}) {
    const double exact = (n - 1) * (n - 1) / ((n + 1) * (n + 1));
    EXPECT_NEAR(dielectric(1, n), exact, roundoff * exact + 1e-9) << n;
    EXPECT_NEAR(dielectric(1, 1 / n), exact, roundoff * exact + 1e-9) << n;
    for (double k : {0.0, 0.5, 3.0}) {
      const double metal = ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
      EXPECT_NEAR(double(fresnel_conductor1(1, real(n), real(k))), metal, 2 * roundoff);
    }
  }
}

TEST(TwinFresnel, GrazingBrewsterAndCritical) {
  EXPECT_EQ(dielectric(0, 1.5), 1.0);
  EXPECT_EQ(dielectric(0, 1 / 1.5), 1.0);
  const double critical = std::sqrt(1 - 1 / 2.25);
  EXPECT_EQ(dielectric(critical * 0.9999, 1 / 1.5), 1.0);
  EXPECT_LT(dielectric(critical * 1.0001, 1 / 1.5), 1.0);
  // At Brewster's angle only the perpendicular half is left: ((n^2-1)/(n^2+1))^2 / 2.
  EXPECT_NEAR(dielectric(1 / std::sqrt(1 + 2.25), 1.5), 0.5 * std::pow(1.25 / 3.25, 2), roundoff);
  EXPECT_NEAR(dielectric(1e-4, 1.0), 0.0, 1e-6);
}

TEST(TwinFresnel, ConductorWithoutAbsorptionIsADielectric) {
  for (double cosine : {1e-3, 0.1, 0.4, 0.7, 1.0})
    EXPECT_NEAR(double(fresnel_conductor1(real(cosine), real(1.5), 0)), dielectric(cosine, 1.5),
                10 * roundoff);
}

TEST(TwinFresnel, DiffuseMeans) {
  EXPECT_NEAR(cosine_mean([](double c) { return dielectric(c, 1.5); }), 0.0917785, 1e-6);
  EXPECT_NEAR(cosine_mean([](double c) { return dielectric(c, 1 / 1.5); }), 0.596346, 2e-6);
  EXPECT_NEAR(cosine_mean([](double c) {
                const double r = dielectric(c, 1.5);
                return (1 - r) / (1 + r);
              }),
              0.844556, 1e-6);
}

TEST(TwinFresnel, Slab) {
  const double angle[] = {0, 45, 60, 80}, known[] = {.923077, .904327, .836232, .441229};
  for (int i = 0; i < 4; ++i) {
    const double r = dielectric(std::cos(angle[i] * pi_d / 180), 1.5);
    EXPECT_NEAR((1 - r) / (1 + r), known[i], 1e-6);
  }
}

const double alphas[] = {1.0, 0.3, 0.05, 5e-3, 1e-3};

/// Cells around the normal with a border exactly on the horizon, where densities jump.
LobeGrid hemisphere_grid(double alpha) {
  constexpr int rings = 100;
  const int above = std::min(int(rings / (1 + 0.5 * alpha)), rings - 1);
  return LobeGrid({0, 0, 1}, double(rings) / above - 1, rings, 16);
}

TEST(TwinGgx, NormalsProjectToOne) {
  for (double alpha : alphas) {
    const LobeGrid grid = hemisphere_grid(alpha);
    const double sum = grid.integral(
        [&](const glm::dvec3& h) {
          return h.z > 0 ? double(ggx_d(to_real3(h), real(alpha))) * h.z : 0.0;
        },
        1e-9);
    EXPECT_NEAR(sum, 1.0, is_float ? 1e-5 : 1e-6) << alpha;
  }
}

TEST(TwinGgx, VisibleNormalsHaveDensityOne) {
  for (double alpha : alphas)
    for (double cosine : {1.0, 0.5, 0.05}) {
      const glm::dvec3 wo(std::sqrt(1 - cosine * cosine), 0, cosine);
      const LobeGrid grid = hemisphere_grid(alpha);
      const double g1 = 2 * cosine / (cosine + double(ggx_v(to_real3(wo), real(alpha))));
      const double sum = grid.integral(
          [&](const glm::dvec3& h) {
            return h.z > 0 ? g1 * std::max(0.0, glm::dot(wo, h)) / cosine *
                                 double(ggx_d(to_real3(h), real(alpha)))
                           : 0.0;
          },
          1e-9);
      EXPECT_NEAR(sum, 1.0, is_float ? 2e-5 : 2e-6) << alpha << " " << cosine;
    }
}

/// D by the tangent form keeps its digits where 1 - cos^2 has none (numerics 12).
TEST(TwinGgx, SmallWidthsKeepTheirDigits) {
  for (double alpha : alphas)
    for (double tangent : {0.0, 0.1, 1.0, 5.0, 100.0}) {
      const double angle = std::atan(alpha * tangent);
      const glm::dvec3 h = glm::dvec3(to_dvec3(to_real3({std::sin(angle), 0, std::cos(angle)})));
      const double t = (h.x * h.x) / (alpha * alpha * h.z * h.z);
      const double exact = 1 / (pi_d * alpha * alpha * std::pow(h.z, 4) * (1 + t) * (1 + t));
      EXPECT_NEAR(double(ggx_d(to_real3(h), real(alpha))) / exact, 1.0, is_float ? 2e-6 : 1e-12);
    }
}

}  // namespace

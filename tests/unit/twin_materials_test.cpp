// Energy and known values of layered and mixed materials: EON, plastic, thin panes, mixes.
#include <gtest/gtest.h>

#include <cmath>

#include "support/double_twin.h"
#include "support/statistics.h"
#include "support/twin_bsdf.h"

namespace {

using namespace twin;
using namespace pellucid::test;
using pellucid::Rgb;

constexpr double pi_d = 3.14159265358979323846;
const double cosines[] = {1.0, 0.9, 0.5, 0.15, 0.02, 1e-3};

BsdfCase seen(const ::Material& m, double cosine) {
  BsdfCase c;
  c.material = m;
  c.wo = {std::sqrt((1 - cosine) * (1 + cosine)), 0, cosine};
  return c;
}

/// What the lobes with a density send back under a white sky, by quadrature of this twin over
/// cosine and azimuth, in pieces that meet where Oren-Nayar has its kinks.
glm::dvec3 albedo(const BsdfCase& c) {
  const double borders[] = {0, c.wo.z, std::min(1.0, 8 * c.wo.z), std::min(1.0, 64 * c.wo.z), 1};
  glm::dvec3 sum(0.0);
  for (int channel = 0; channel < 3; ++channel)
    for (int i = 0; i < 4; ++i)
      for (double from : {-0.5 * pi_d, 0.5 * pi_d})
        sum[channel] += integrate(
            [&](double cosine, double azimuth) {
              const double sine = std::sqrt((1 - cosine) * (1 + cosine));
              const real3 wi = REAL3(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
              return to_dvec3(evaluate(c, 0, wi).f)[channel] * cosine;
            },
            borders[i], borders[i + 1], from, from + pi_d, 1e-8);
  return sum;
}

/// [Portsmouth24] as printed, with its subtractions.
double eon_albedo(double mu, double r) {
  const double a = 1 / (1 + (0.5 - 2 / (3 * pi_d)) * r), theta = std::acos(mu), s = std::sin(theta);
  const double g = s * (theta - s * mu) + 2.0 / 3.0 * (s / mu * (1 - s * s * s) - s);
  return a * (1 + r * g / pi_d);
}
double eon(const glm::dvec3& o, const glm::dvec3& i, double rho, double r) {
  const double a = 1 / (1 + (0.5 - 2 / (3 * pi_d)) * r);
  const double mean = a * (1 + (2.0 / 3.0 - 28 / (15 * pi_d)) * r);
  const double s = glm::dot(o, i) - o.z * i.z, t = s > 0 ? std::max(o.z, i.z) : 1;
  const double rho_ms = rho * rho * mean / (1 - rho * (1 - mean));
  return rho / pi_d * a * (1 + r * s / t) +
         rho_ms / pi_d * (1 - eon_albedo(o.z, r)) * (1 - eon_albedo(i.z, r)) / (1 - mean);
}

TEST(TwinOrenNayar, IsThePublishedFormula) {
  Random random(1);
  for (double r : {0.05, 0.5, 1.0})
    for (int k = 0; k < 2000; ++k) {
      glm::dvec3 o = random.direction(), i = random.direction();
      o.z = std::max(std::abs(o.z), 1e-2), i.z = std::max(std::abs(i.z), 1e-2);
      o = to_dvec3(to_real3(glm::normalize(o))), i = to_dvec3(to_real3(glm::normalize(i)));
      BsdfCase c = seen(oren_nayar({0.9, 0.3, 1.0}, r), 1);
      c.wo = o;
      const glm::dvec3 f = to_dvec3(evaluate(c, 0, to_real3(i)).f);
      const double packed[] = {double(0.9f), double(0.3f), 1.0}, rough = double(float(r));
      for (int n = 0; n < 3; ++n) {
        const double exact = eon(o, i, packed[n], rough);
        // Some ten roundings, relative to the terms, which may cancel but for multiple scattering.
        const double s = glm::dot(o, i) - o.z * i.z, t = s > 0 ? std::max(o.z, i.z) : 1;
        const double terms = packed[n] / pi_d * (1 + std::abs(s) / t);
        ASSERT_NEAR(f[n], exact, (is_float ? 1e-6 : 1e-12) * terms)
            << r << " " << o.z << " " << i.z;
      }
    }
}

/// White keeps all light at every angle and roughness; nothing is brighter.
TEST(TwinOrenNayar, WhiteFurnace) {
  for (double r : {0.0, 1e-3, 0.3, 1.0})
    for (double mu : cosines) {
      const glm::dvec3 a = albedo(seen(oren_nayar({1.0, 0.5, 0.0}, r), mu));
      EXPECT_NEAR(a.x, 1.0, 2e-6) << r << " " << mu;
      EXPECT_LT(a.y, 0.5 + 2e-6) << r << " " << mu;
      EXPECT_EQ(a.z, 0.0);
    }
}

TEST(TwinOrenNayar, SmoothIsLambert) {
  for (double mu : cosines) {
    const BsdfEval e = evaluate(seen(oren_nayar(Rgb(0.7), 0), mu), 0, REAL3(0.6, 0, 0.8));
    EXPECT_NEAR(double(e.f.x) * pi_d, 0.7, 1e-7);
  }
}

/// Smooth coat: R + T base, base = rho (1 - F) / (1 - rho F); with a white base exactly 1 (CF17).
TEST(TwinPlastic, SmoothCoatLosesNothing) {
  const double inner = 0.596346;  // numerics.md, n = 1.5
  for (double mu : cosines) {
    const double reflected = fresnel_of(mu, 1.5);
    const glm::dvec3 a = albedo(seen(plastic({1.0, 0.5, 0.0}, 1.5, 0), mu));
    EXPECT_NEAR(reflected + a.x, 1.0, 2e-6) << mu;
    EXPECT_NEAR(a.y, (1 - reflected) * 0.5 * (1 - inner) / (1 - 0.5 * inner), 2e-6) << mu;
    EXPECT_EQ(a.z, 0.0);
  }
  EXPECT_NEAR(double(plastic(Rgb(0.5), 1.5, 0).eta_specular.x), inner, 1e-6);
  EXPECT_NEAR(double(plastic(Rgb(0.5), 1.0, 0).eta_specular.x), 0.0, 1e-12);
}

/// Rough coats lose what single scattering at facets loses. The base is lit through a smooth coat,
/// so nothing makes the sum exactly 1: it may exceed that by 5e-4 (n = 1.5), 8e-4 (any n to 3), but
/// no more; a stronger coat at grazing angles is what is missing.
TEST(TwinPlastic, RoughCoatGainsNothingThatMatters) {
  for (double ior : {1.33, 1.5, 3.0})
    for (double alpha : {0.05, 0.1, 0.25, 1.0})
      for (double mu : {1.0, 0.7, 0.5, 0.15}) {
        const BsdfCase c = seen(plastic(Rgb(1.0), ior, alpha), mu);
        const LobeShape shape = reflection_shape(c);
        const double a =
            LobeGrid(shape.axis, shape.width, 40, 16)
                .integral(
                    [&](const glm::dvec3& w) {
                      return w.z > 0 ? double(evaluate(c, 0, to_real3(w)).f.x) * w.z : 0.0;
                    },
                    1e-6);
        EXPECT_LT(a, 1 + 8e-4) << ior << " " << alpha << " " << mu;
        if (mu == 1.0 && ior <= 1.5 && alpha <= 0.25) {
          EXPECT_GT(a, 0.997) << ior << " " << alpha << " " << mu;
        }
      }
}

/// All echoes: 2 R / (1 + R) back, the rest straight on, nothing lost (CF9).
TEST(TwinThinDielectric, IsAPaneWithAllEchoes) {
  const double degrees[] = {0, 45, 60, 80}, through[] = {0.923077, 0.904327, 0.836232, 0.441229};
  for (int k = 0; k < 4; ++k) {
    const BsdfCase c = seen(pane(1.5), std::cos(degrees[k] * pi_d / 180));
    const SceneData scene = only_materials(c);
    for (double lobe : {0.0, 1 - through[k] - 2e-6, 1 - through[k] + 2e-6, 1 - 0x1p-24}) {
      if (lobe < 0) continue;
      const BsdfSample s =
          material_sample(&scene, c.material, context_of(c, 0), &untextured, 1, real(lobe), 0, 0);
      EXPECT_TRUE(s.delta);
      EXPECT_EQ(double(s.weight.x), 1.0);
      EXPECT_EQ(s.wi.x, -to_real3(c.wo).x);
      EXPECT_EQ(s.wi.z, lobe < 1 - through[k] ? real(c.wo.z) : -real(c.wo.z)) << lobe;
    }
  }
}

/// A mix is the sum of its parts, and knows what they do.
TEST(TwinMix, IsTheWeightedSum) {
  Random random(4);
  int mixes = 0;
  for (const BsdfCase& c : density_cases()) {
    if (c.material.kind != MATERIAL_MIX) continue;
    ++mixes;
    uint lobes = 0;
    double weights = 0;
    for (uint i = 0; i < c.material.part_count; ++i) {
      lobes |= c.parts[c.material.first_part + i].lobes;
      weights += double(c.parts[c.material.first_part + i].weight);
    }
    EXPECT_EQ(c.material.lobes, lobes);
    EXPECT_NEAR(weights, 1.0, 1e-6);
    for (int k = 0; k < 100; ++k) {
      const glm::dvec3 wi = random.direction();
      double f = 0, density = 0;
      for (uint i = 0; i < c.material.part_count; ++i) {
        const ::Material& part = c.parts[c.material.first_part + i];
        const BsdfContext context{to_real3(c.wo), material_eta(part, real(c.side)), 0};
        const BsdfEval e = bsdf_eval(part, context, to_real3(wi));
        f += double(part.weight) * double(e.f.x);
        density += double(part.weight) * double(e.pdf_w);
      }
      const BsdfEval e = evaluate(c, 0, to_real3(wi));
      ASSERT_NEAR(double(e.f.x), f, 1e-6 * f);
      ASSERT_NEAR(double(e.pdf_w), density, 1e-6 * density);
    }
  }
  EXPECT_GE(mixes, 5 * 4);
}

}  // namespace

// Sampling against evaluation, reciprocity, delta lobes and hostile input, for every lobe.
#include <gtest/gtest.h>

#include "support/bsdf_cases.h"
#include "support/double_twin.h"
#include "support/test_scenes.h"
#include "support/twin_bsdf.h"

namespace {

using namespace twin;
using namespace pellucid::test;

double relative(double a, double b) {
  return std::abs(a - b) / std::max(std::abs(b), 1e-300);
}

TEST(TwinBsdf, DensityOfSampleIsDensityEvaluated) {
  unsigned seed = 1;
  double worst = 0;  // where rounding of directions alone accounts for less than 1e-5
  long judged = 0, all = 0;
  for (const BsdfCase& c : density_cases()) {
    for (int importance : {0, 1}) {
      Random random(++seed);
      int beyond = 0;
      for (int i = 0; i < 10000; ++i) {
        const BsdfSample s = draw(c, importance, random);
        if (s.pdf_w == 0) continue;
        const BsdfEval e = evaluate(c, importance, s.wi);
        const double error = relative(double(e.pdf_w), double(s.pdf_w));
        // 1e-4 is what MIS is asked for; in float the direction itself is only known to a few
        // roundoffs, which the lobe amplifies by its slope. Double has no such excuse.
        const double directions = is_float ? half_vector_error(c, to_dvec3(s.wi)) : 0;
        const double tolerance = is_float ? 1e-4 + directions : 1e-6;
        // Next to the horizon the slope of masking adds to it: cosines have absolute errors.
        const double grazing = is_float ? 1e-6 / std::abs(double(s.wi.z)) : 0;
        beyond += error > tolerance + grazing;
        ++all;
        if (directions + grazing < 1e-5) worst = std::max(worst, error), ++judged;
        const double weight = double(e.f.x) * std::abs(double(s.wi.z)) / double(e.pdf_w);
        if (e.pdf_w > 0 && relative(weight, double(s.weight.x)) > tolerance + grazing) ++beyond;
      }
      // Half vectors of nearly matched indices are all rounding: facets seen at grazing angles may
      // flip. The double build has no such samples.
      const bool matched = is_float && c.eta != 1.0 && std::abs(c.eta - 1.0) < 1e-3;
      EXPECT_LE(beyond, matched ? 10 : 0) << c.name << " importance " << importance;
    }
  }
  std::printf("density of sample against evaluation: off by at most %.2e in %ld of %ld samples\n",
              worst, judged, all);
}

/// Opaque lobes and reflection: f(a, b) = f(b, a). Refraction [Veach97 5.2]: radiance
/// f(a -> b) / eta_b^2 is symmetric, so with eta = eta_b / eta_a: f(a,b) eta^2 = f'(b,a), f' seen
/// from the other side; importance is the adjoint, so f_imp(a, b) = f_rad(b, a).
TEST(TwinBsdf, Reciprocity) {
  Random random(2);
  for (const BsdfCase& c : density_cases()) {
    if (c.wo.z < 0.1) continue;  // one list of materials is enough
    const bool glassy = bsdf_is_transmissive(c.material);
    int compared = 0;
    for (int i = 0; i < 3000; ++i) {
      const BsdfSample s = draw(c, 0, random);
      if (s.pdf_w == 0 || std::abs(s.wi.z) < real(0.02)) continue;
      const bool through = glassy && s.wi.z < 0;
      BsdfCase back = c;
      back.wo = to_dvec3(s.wi);
      real3 wo = to_real3(c.wo);
      if (through) {  // the frame turns over with the side, and the index with it
        back.wo.z = -back.wo.z;
        wo.z = -wo.z;
        back.eta = 1 / c.eta;
        back.side = -c.side;
      }
      const double forth = double(evaluate(c, 0, s.wi).f.x);
      const double radiance = double(evaluate(back, 0, wo).f.x);
      const double eta2 = through ? c.eta * c.eta : 1.0;
      const double adjoint = double(evaluate(c, 1, s.wi).f.x);
      ++compared;
      const double tolerance = is_float ? 1e-4 + 2 * (half_vector_error(c, to_dvec3(s.wi)) +
                                                      half_vector_error(back, to_dvec3(wo)))
                                        : 1e-8;
      ASSERT_LT(relative(forth * eta2, radiance), tolerance) << c.name;
      ASSERT_LT(relative(adjoint, radiance), tolerance) << c.name;
    }
    EXPECT_GT(compared, 300) << c.name;  // smooth coats at grazing angles leave few
  }
}

TEST(TwinBsdf, SmoothGlassIsLossless) {
  const ::Material m = glass(1.5, 0);
  for (double eta : {1.5, 1 / 1.5, 1.0001, 2.4, 1.0}) {
    const double critical = eta < 1 ? std::sqrt(1 - eta * eta) : 0.5;
    std::vector<real> cosines;
    for (int i = 1; i <= 200000; ++i) cosines.push_back(real(i / 200000.0));
    for (real c = std::nextafter(std::nextafter(real(critical), real(0)), real(0));
         cosines.size() < 200005; c = std::nextafter(c, real(2)))
      cosines.push_back(c);  // the critical angle and 2 ulps to either side
    for (real cosine : cosines) {
      real cos_t;
      const real r = fresnel_dielectric(cosine, real(eta), &cos_t);
      ASSERT_TRUE(r >= 0 && r <= 1) << eta << " " << cosine;
      ASSERT_TRUE(cos_t >= 0 && cos_t <= 1);
      const BsdfContext c{REAL3(std::sqrt(1 - cosine * cosine), 0, cosine), real(eta), 1};
      const BsdfSample reflected = bsdf_sample(m, c, 0, 0, 0);
      const BsdfSample other = bsdf_sample(m, c, real(1 - 0x1p-24), 0, 0);
      // Each lobe is drawn with its own probability: R + T = 1 if both weights are 1.
      ASSERT_EQ(double(reflected.weight.x), 1.0);
      ASSERT_EQ(double(other.weight.x), 1.0);
      ASSERT_NEAR(double(dot3(other.wi, other.wi)), 1.0, 2e-6) << eta << " " << cosine;
      if (other.wi.z < 0) {  // Snell, and the same reflectance from the other side
        ASSERT_NEAR(double(other.wi.x) * eta, -double(c.wo.x), 1e-6);
        real back;
        const real r2 = fresnel_dielectric(-other.wi.z, real(1) / real(eta), &back);
        // d(cos)/d(cos_t) diverges at grazing: there the reflectance itself is ill-conditioned.
        ASSERT_NEAR(double(r2), double(r), 4e-6 / double(cosine * cos_t));
      }
    }
  }
}

TEST(TwinBsdf, MirrorsReflectAll) {
  Random random(3);
  ::Material m{};
  m.kind = MATERIAL_MIRROR;
  m.reflectance = F4{1, 1, 1, 0};
  for (int i = 0; i < 1000; ++i) {
    glm::dvec3 w = random.direction();
    w.z = std::abs(w.z);
    const BsdfSample s = bsdf_sample(m, {to_real3(w), 1, 0}, 0, 0, 0);
    EXPECT_TRUE(s.delta);
    EXPECT_EQ(double(s.weight.x), 1.0);
    EXPECT_EQ(s.wi.z, real(w.z));
    EXPECT_EQ(s.wi.x, -real(w.x));
  }
}

bool sane(real3 v) {
  return is_finite(v.x) && is_finite(v.y) && is_finite(v.z) && v.x >= 0 && v.y >= 0 && v.z >= 0;
}

/// Cosines down to what rotating a float direction into a frame can produce at all.
std::vector<glm::dvec3> hostile_directions() {
  std::vector<glm::dvec3> all;
  for (double z : {1.0, 0.5, 1e-3, 1e-7, 1e-12, 1e-20, 1e-30, 1e-38})
    for (double x : {1.0, -1.0}) all.emplace_back(x * std::sqrt((1 - z) * (1 + z)), 0, z);
  all.emplace_back(std::sqrt(0.5), std::sqrt(0.5) - 1e-8, 1e-8);
  return all;
}

std::vector<std::pair<::Material, double>> hostile_materials() {
  std::vector<std::pair<::Material, double>> all = {{diffuse({1, 1, 1}), 1.0},
                                                    {diffuse({0, 0, 0}), 1.0}};
  for (double n : {0.0, 1e-3, 1.0, 1e4, 1e7}) {
    all.emplace_back(phong({0.5, 0, 0}, {0.5, 1, 0}, n), 1.0);
    all.emplace_back(phong({0, 0, 0}, {1, 1, 1}, n), 1.0);
  }
  all.emplace_back(phong({0, 0, 0}, {0, 0, 0}, 5), 1.0);
  for (double rho : {0.0, 1.0}) {
    for (double r : {0.0, 1e-30, 1e-3, 1.0})
      all.emplace_back(oren_nayar(pellucid::Rgb(rho), r), 1.0);
    for (double ior : {1.0, 1.0 + 1e-6, 1.5, 3.0})
      for (double alpha : {0.0, 1e-3, 0.5, 1.0})
        all.emplace_back(plastic(pellucid::Rgb(rho), ior, alpha), 1.0);
  }
  for (double ior : {0.1, 1.0, 1.5, 10.0}) all.emplace_back(pane(ior), 1.0);
  for (double alpha : {0.0, 1e-3, 0.5, 1.0}) {
    all.emplace_back(gold(alpha), 1.0);
    for (double ior : {1.0, 1.0 + 1.1e-4, 1.5, 1 / 1.5, 10.0, 0.1}) {
      all.emplace_back(glass(ior, alpha), ior);
      all.emplace_back(glass(ior, alpha), 1 / ior);
    }
  }
  return all;
}

TEST(TwinBsdf, HostileSamplesAreSane) {
  const double ends[] = {0, 0x1p-24, 0.5, 1 - 0x1p-24};
  int bad = 0;
  for (const auto& [m, eta] : hostile_materials())
    for (const glm::dvec3& wo : hostile_directions())
      for (int k = 0; k < 64 * 2; ++k) {
        const BsdfContext c{to_real3(wo), real(eta), k >> 6};
        const BsdfSample s = bsdf_sample(m, c, real(ends[k & 3]), real(ends[(k >> 2) & 3]),
                                         real(ends[(k >> 4) & 3]));
        const bool ok = sane(s.weight) && s.pdf_w >= 0 && is_finite(dot3(s.wi, s.wi)) &&
                        (s.pdf_w > 0 || s.delta || is_black(s.weight));
        if (!ok && ++bad < 10)
          ADD_FAILURE() << "kind " << m.kind << " alpha " << m.alpha << " eta " << eta << " wo "
                        << wo.x << " " << wo.z << " u " << k << ": weight " << s.weight.x << " pdf "
                        << s.pdf_w << " wi.z " << s.wi.z << " n " << m.eta_specular.w;
      }
  EXPECT_EQ(bad, 0);
}

TEST(TwinBsdf, HostileEvaluationsAreSane) {
  int bad = 0;
  for (const auto& [m, eta] : hostile_materials())
    for (const glm::dvec3& wo : hostile_directions())
      for (glm::dvec3 wi : hostile_directions())
        for (double sign : {1.0, -1.0, 0.0}) {
          wi.z = sign == 0.0 ? 0.0 : sign * std::abs(wi.z);
          for (int importance : {0, 1}) {
            const BsdfEval e = bsdf_eval(m, {to_real3(wo), real(eta), importance}, to_real3(wi));
            if (sane(e.f) && e.pdf_w >= 0 && is_finite(e.pdf_w)) continue;
            if (++bad < 10)
              ADD_FAILURE() << "kind " << m.kind << " alpha " << m.alpha << " eta " << eta << " wo "
                            << wo.x << " " << wo.z << " wi " << wi.x << " " << wi.z << ": f "
                            << e.f.x << " pdf " << e.pdf_w;
          }
        }
  EXPECT_EQ(bad, 0);
}

TEST(TwinBsdf, OpaqueLobesScatterNothingBehind) {
  for (const auto& [m, eta] : hostile_materials()) {
    if (bsdf_is_transmissive(m)) continue;
    const BsdfEval e = bsdf_eval(m, {REAL3(0, 0, 1), 1, 0}, REAL3(0.6, 0, -0.8));
    EXPECT_TRUE(is_black(e.f));
    EXPECT_EQ(double(e.pdf_w), 0.0);
  }
}

}  // namespace

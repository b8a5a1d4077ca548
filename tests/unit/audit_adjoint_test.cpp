// Scattering seen from both ends: the adjoint BSDF of light walks [Veach97 5.3.2], densities of the
// way back, and what refraction does to them.
#include <gtest/gtest.h>

#include "support/audit_scenes.h"
#include "support/twin.h"

namespace {

using namespace twin;
using namespace pellucid::test;

/// A point of material `material` whose normals differ by up to 0.6 rad.
Surface bent_surface(Random& random, uint material, bool smooth) {
  Surface s{};
  s.ng = s.ns = to_real3(random.direction());
  if (smooth) {
    glm::dvec3 n = to_dvec3(s.ng) + 0.6 * random.uniform() * random.direction();
    s.ns = normalize3(to_real3(n));
  }
  s.material = material;
  s.flags = SHAPE_TEXTURED | SHAPE_SMOOTH;
  s.light = NONE;
  s.u = real(random.uniform()), s.v = real(random.uniform());
  return s;
}

double cosine(real3 n, real3 w) {
  return std::abs(double(dot3(n, w)));
}

/// From the eye f |wi.ns| goes with the flux through |wi.ng|, from the light its adjoint with that
/// through |wo.ng|: for every material, for reflection and transmission.
TEST(AuditAdjoint, BothEndsSeeOneBsdf) {
  const TwinScene twin(audit_room(false));
  Random random(1);
  // Float: narrow lobes multiply the roundoff of directions, and where a facet is grazed, far out
  // in the tail of its distribution, all digits are lost.
  const double tolerance = is_float ? 2e-3 : 1e-9, tail = is_float ? 1e-6 : 1e-12;
  const std::size_t count = twin.packed.materials.size();  // parts of mixes are materials, too
  for (uint material = 0; material < count; ++material) {
    int passed = 0, through = 0;
    for (int i = 0; i < 4000; ++i) {
      const Surface surface = bent_surface(random, material, i % 2);
      const real3 wo = to_real3(random.direction()), wi = to_real3(random.direction());
      if (std::min({cosine(surface.ng, wo), cosine(surface.ng, wi), cosine(surface.ns, wo),
                    cosine(surface.ns, wi)}) < 0.02)
        continue;
      const Vertex eye = vertex_at(&twin.data, surface, wo, 0),
                   light = vertex_at(&twin.data, surface, wi, 1);
      const BsdfEval e = vertex_eval(&twin.data, &eye, wi);
      const BsdfEval l = vertex_eval(&twin.data, &light, wo);
      const double from_eye = double(e.f.x) / cosine(surface.ng, wi);
      const double from_light = double(l.f.x) / cosine(surface.ng, wo);
      ASSERT_NEAR(from_light, from_eye, tolerance * from_eye + tail) << "material " << material;
      // The density of the way back is that of a walk which comes from there.
      ASSERT_NEAR(double(vertex_pdf_reverse(&twin.data, &eye, wi)), double(l.pdf_w),
                  tolerance * double(l.pdf_w) + tail);
      ASSERT_NEAR(double(vertex_pdf_reverse(&twin.data, &light, wo)), double(e.pdf_w),
                  tolerance * double(e.pdf_w) + tail);
      if (from_eye > 0) ++passed;
      if (from_eye > 0 && dot3(surface.ng, wi) * dot3(surface.ng, wo) < real(0)) ++through;
    }
    const ::Material& m = twin.packed.materials[material];
    if (m.lobes & LOBE_SPREAD) {
      EXPECT_GT(passed, 500) << "material " << material;
    }
    if (m.kind == MATERIAL_ROUGH_DIELECTRIC) {
      EXPECT_GT(through, 100) << "material " << material;
    }
  }
}

/// A delta lobe of the vertex, drawn with `lobe`.
BsdfSample drawn(const TwinScene& twin, const Surface& surface, real3 wo, real lobe) {
  const Vertex v = vertex_at(&twin.data, surface, wo, 0);
  return vertex_sample(&twin.data, &v, lobe, real(0.5), real(0.5), real(0.5));
}

/// Solid angle that a small cone of directions around wo is mapped to, over its own.
double spread_of(const TwinScene& twin, const Surface& surface, const glm::dvec3& wo, real lobe) {
  const double h = is_float ? 3e-3 : 1e-5;
  const glm::dvec3 s = glm::normalize(glm::cross(wo, glm::dvec3(0.3, 0.5, 0.7)));
  const glm::dvec3 t = glm::cross(wo, s);
  const auto at = [&](const glm::dvec3& w) {
    return to_dvec3(drawn(twin, surface, to_real3(glm::normalize(w)), lobe).wi);
  };
  const glm::dvec3 ds = (at(wo + h * s) - at(wo - h * s)) / (2 * h);
  const glm::dvec3 dt = (at(wo + h * t) - at(wo - h * t)) / (2 * h);
  return glm::length(glm::cross(ds, dt));
}

TEST(AuditAdjoint, DeltaLobesKnowTheirWayBack) {
  const pellucid::Scene scene = audit_room(false);
  const TwinScene twin(scene);
  Random random(2);
  for (const char* name : {"glass", "pane", "mirror", "mirror, plastic and glass"}) {
    const uint material = uint(audit_material(scene, name));
    int bent = 0, drawn_at_all = 0;
    for (int i = 0; i < 3000; ++i) {
      const Surface surface = bent_surface(random, material, false);
      const glm::dvec3 wo = random.direction();
      const double cos_o = std::abs(glm::dot(to_dvec3(surface.ng), wo));
      // Away from grazing and from the critical angle (0.745), where the map has no derivative.
      if (cos_o < 0.2 || std::abs(cos_o - 0.745) < 0.05) continue;
      const real lobe = real(random.unit24());
      const BsdfSample s = drawn(twin, surface, to_real3(wo), lobe);
      if (!s.delta || is_black(s.weight)) continue;
      ++drawn_at_all;
      const double exact = spread_of(twin, surface, wo, lobe);
      if (std::abs(exact - 1) > 0.1) ++bent;
      // Finite differences: h^2 times third derivatives, 1/h roundoffs. A neighbour may have drawn
      // another lobe.
      if (exact > 10) continue;
      ASSERT_NEAR(double(s.reverse), exact, (is_float ? 2e-2 : 1e-5) * exact) << name;
    }
    EXPECT_GT(drawn_at_all, 300) << name;
    const bool bends = twin.packed.materials[material].lobes & LOBE_TRANSMIT;
    if (bends && std::string(name) != "pane") {
      EXPECT_GT(bent, 100) << name;
    }
  }
}

/// The choice of a delta lobe is as probable on the way back: the ratio of densities is that of
/// solid angles alone.
TEST(AuditAdjoint, DeltaLobesAreDrawnAlikeBothWays) {
  const pellucid::Scene scene = audit_room(false);
  const TwinScene twin(scene);
  Random random(3);
  constexpr int strata = 2000;
  for (const char* name : {"glass", "pane", "plastic", "mirror, plastic and glass"}) {
    const uint material = uint(audit_material(scene, name));
    const auto probability = [&](const Surface& surface, real3 wo, real3 wi) {
      int hits = 0;
      for (int k = 0; k < strata; ++k) {
        const BsdfSample s = drawn(twin, surface, wo, real((k + 0.5) / strata));
        if (s.delta && double(dot3(s.wi, wi)) > 1 - 1e-5) ++hits;
      }
      return double(hits) / strata;
    };
    for (int i = 0; i < 60; ++i) {
      const Surface surface = bent_surface(random, material, false);
      const real3 wo = to_real3(random.direction());
      const BsdfSample s = drawn(twin, surface, wo, real(random.unit24()));
      if (!s.delta || is_black(s.weight) || cosine(surface.ng, wo) < 0.1) continue;
      const double there = probability(surface, wo, s.wi), back = probability(surface, s.wi, wo);
      // Up to four lobes share the strata, each known to one of them at both its ends.
      ASSERT_NEAR(back, there, 4.0 / strata) << name;
    }
  }
}

}  // namespace

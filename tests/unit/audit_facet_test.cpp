// Shading normals that disagree with the facet (kernels/transport/facet.h): lobes keep their energy
// from wherever they are seen, samples agree with what is evaluated, and delta lobes know their way
// back.
#include <gtest/gtest.h>

#include "support/audit_scenes.h"
#include "support/statistics.h"
#include "support/twin.h"

namespace {

using namespace twin;
using namespace pellucid::test;

/// A facet whose normals differ by up to 75 degrees, on either side of each other.
Surface facet_of(Random& random, uint material) {
  Surface s{};
  s.ng = to_real3(random.direction());
  const glm::dvec3 across =
      glm::normalize(glm::cross(to_dvec3(s.ng), to_dvec3(to_real3(random.direction()))));
  const double angle = 1.3 * random.uniform() * random.uniform();
  const double turn = random.uniform() < 0.5 ? -1 : 1;
  s.ns = to_real3(turn * (std::cos(angle) * to_dvec3(s.ng) + std::sin(angle) * across));
  s.material = material;
  s.flags = SHAPE_SMOOTH;
  s.light = NONE;
  return s;
}

bool grazes(const Surface& s, real3 w) {
  return std::min(std::abs(double(dot3(s.ng, w))), std::abs(double(dot3(s.ns, w)))) < 0.02;
}

/// Its shading normal's plane alone, seen as the vertex sees it.
Vertex flattened(const TwinScene& twin, const Vertex& v) {
  Surface flat = v.surface;
  flat.ng = flat.ns = v.frame.n * v.side;
  return vertex_at(&twin.data, flat, to_world(v.frame, v.context.wo), int(v.context.importance));
}

BsdfSample sample(const TwinScene& twin, const Vertex& v, Random& random) {
  const auto next = [&] { return real(random.unit24()); };
  const real lobe = next(), u1 = next(), u2 = next(), choice = next();
  return vertex_sample(&twin.data, &v, lobe, u1, u2, choice);
}

/// What an eye path goes on with is what the lobe sends back without a facet, also where the camera
/// looks from behind the shading plane: the furnace at every point (numerics 8).
TEST(AuditFacet, LobesKeepTheirEnergy) {
  const pellucid::Scene scene = audit_room(false);
  const TwinScene twin(scene);
  Random random(11);
  const uint count = uint(scene.materials.size());
  int behind = 0, folded = 0;
  for (uint material = 0; material < count; ++material) {
    for (int i = 0; i < 40; ++i) {
      const Surface s = facet_of(random, material);
      const real3 wo = to_real3(random.direction());
      if (grazes(s, wo)) continue;
      const Vertex v = vertex_at(&twin.data, s, wo, 0), flat = flattened(twin, v);
      if (dot3(s.ns, wo) * dot3(s.ng, wo) * dot3(s.ns, s.ng) < real(0)) ++behind;
      Moments difference, here;
      for (int k = 0; k < 4000; ++k) {
        Random same(1000 * i + k), again(1000 * i + k);
        const BsdfSample bent = sample(twin, v, same), straight = sample(twin, flat, again);
        difference.add(double(bent.weight.x - straight.weight.x));
        here.add(double(bent.weight.x));
        if (bent.pdf_w != straight.pdf_w) ++folded;
      }
      // 5 standard errors of some 500 tests; roundoffs of the sum beside them.
      ASSERT_NEAR(difference.mean, 0, 5 * difference.standard_error() + 1e-5)
          << "material " << material << ", of " << here.mean;
    }
  }
  EXPECT_GT(behind, 20);
  EXPECT_GT(folded, 10000);
}

/// A white matte facet sends back every sample whole, from wherever it is seen.
TEST(AuditFacet, MatteFacetsAreWhiteSampleBySample) {
  const pellucid::Scene scene = audit_room(false);
  const TwinScene twin(scene);
  const uint material = uint(audit_material(scene, "diffuse"));
  const double albedo = twin.packed.materials[material].reflectance.x;
  Random random(12);
  for (int i = 0; i < 20000; ++i) {
    const Vertex v =
        vertex_at(&twin.data, facet_of(random, material), to_real3(random.direction()), 0);
    if (v.context.wo.z < real(1e-3)) continue;
    ASSERT_NEAR(double(sample(twin, v, random).weight.x), albedo, is_float ? 1e-6 : 1e-12);
  }
}

/// Sampling and evaluation are one density and one f, for walks from both ends.
TEST(AuditFacet, SamplesAgreeWithEvaluation) {
  const pellucid::Scene scene = audit_room(false);
  const TwinScene twin(scene);
  Random random(13);
  // Narrow lobes multiply the roundoff of directions.
  const double tolerance = is_float ? 5e-3 : 1e-8;
  const uint count = uint(scene.materials.size());
  for (uint material = 0; material < count; ++material) {
    int compared = 0;
    for (int i = 0; i < 6000; ++i) {
      const Surface s = facet_of(random, material);
      const real3 wo = to_real3(random.direction());
      const Vertex v = vertex_at(&twin.data, s, wo, i % 2);
      if (v.black || grazes(s, wo)) continue;
      const BsdfSample drawn = sample(twin, v, random);
      if (is_black(drawn.weight) || drawn.delta || grazes(s, drawn.wi)) continue;
      const BsdfEval e = vertex_eval(&twin.data, &v, drawn.wi);
      const double pdf = double(e.pdf_w), f = double(e.f.x);
      ASSERT_NEAR(double(drawn.pdf_w), pdf, tolerance * pdf) << "material " << material;
      ASSERT_NEAR(double(drawn.weight.x) * pdf, f, tolerance * f) << "material " << material;
      ++compared;
    }
    if (twin.packed.materials[material].lobes & LOBE_SPREAD) {
      EXPECT_GT(compared, 300) << "material " << material;
    }
  }
}

/// The density adds up over all directions to the share of samples that go on, and so for walks
/// from lights, which may leave on either side of the shading plane.
TEST(AuditFacet, DensitiesAddUp) {
  const pellucid::Scene scene = audit_room(false);
  const TwinScene twin(scene);
  Random random(14);
  for (const char* name : {"diffuse", "oren-nayar", "phong", "rough plastic", "rough metal",
                           "rough glass", "paint and metal"}) {
    const uint material = uint(audit_material(scene, name));
    for (int i = 0; i < 24; ++i) {
      const Surface s = facet_of(random, material);
      const real3 wo = to_real3(random.direction());
      const Vertex v = vertex_at(&twin.data, s, wo, i % 2);
      if (v.black || grazes(s, wo)) continue;
      Moments drawn, density;
      for (int k = 0; k < 20000; ++k) {
        drawn.add(is_black(sample(twin, v, random).weight) ? 0 : 1);
        const real3 wi = to_real3(random.direction());
        density.add(4 * 3.14159265358979323846 * double(vertex_eval(&twin.data, &v, wi).pdf_w));
      }
      const double noise = std::hypot(drawn.standard_error(), density.standard_error());
      ASSERT_NEAR(density.mean, drawn.mean, 5 * noise + 1e-3)
          << name << (i % 2 ? " light" : " eye");
    }
  }
}

/// Eye and light walks through a delta lobe: what one knows of the way back is what the other does.
TEST(AuditFacet, DeltaLobesKnowTheirWayBack) {
  const pellucid::Scene scene = audit_room(false);
  const TwinScene twin(scene);
  Random random(15);
  constexpr int tries = 2000;
  for (const char* name : {"mirror", "metal", "glass", "pane"}) {
    const uint material = uint(audit_material(scene, name));
    int bent = 0;
    for (int i = 0; i < 300; ++i) {
      const Surface s = facet_of(random, material);
      const real3 wo = to_real3(random.direction());
      const Vertex eye = vertex_at(&twin.data, s, wo, 0);
      const BsdfSample there = sample(twin, eye, random);
      if (is_black(there.weight) || grazes(s, wo) || grazes(s, there.wi)) continue;
      const Vertex light = vertex_at(&twin.data, s, there.wi, 1);
      ASSERT_FALSE(light.black) << name;
      Moments returns, same_lobe;
      double reverse = 0, adjoint = 0;
      for (int k = 0; k < tries; ++k) {
        const BsdfSample back = sample(twin, light, random);
        const bool home = !is_black(back.weight) && double(dot3(back.wi, wo)) > 1 - 1e-4;
        returns.add(home), same_lobe.add(sample(twin, eye, random).wi.x == there.wi.x);
        if (home) reverse = double(back.reverse), adjoint = double(back.weight.x);
      }
      ASSERT_GT(returns.mean, 0) << name;
      ASSERT_NEAR(double(there.reverse) * reverse, 1, is_float ? 1e-2 : 1e-6) << name;
      // The adjoint K |wo.ng| / |wi.ng|, over the density of the way back (refraction included: its
      // ratio of solid angles is in `reverse`).
      const double cosines =
          std::abs(double(dot3(s.ng, wo))) / std::abs(double(dot3(s.ng, there.wi)));
      const double weight = double(there.weight.x) * cosines / double(there.reverse);
      ASSERT_NEAR(adjoint, weight, (is_float ? 1e-2 : 1e-6) * weight) << name;
      // Beside the ratio of solid angles, the choice of lobe is as probable both ways.
      const double cos_o = double(eye.context.wo.z);
      const bool through = dot3(s.ng, wo) * dot3(s.ng, there.wi) < real(0);
      if (through && std::string(name) == "glass") continue;  // the ratio is not 1
      const double choice = double(there.reverse) * same_lobe.mean;
      const double noise = std::hypot(returns.standard_error(), same_lobe.standard_error());
      ASSERT_NEAR(returns.mean, choice, 5 * noise + 1e-3) << name << " under " << cos_o;
      if (double(there.reverse) < 0.99) ++bent;
    }
    EXPECT_GT(bent, 3) << name;
  }
}

}  // namespace

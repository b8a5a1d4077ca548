// A BsdfCase put to the twin: the calls that a vertex makes, with nothing of a scene but materials.
#pragma once

#include "support/bsdf_cases.h"
#include "support/twin.h"

namespace TWIN_NAMESPACE {

/// Where cases lie: no texture coordinates.
const Surface untextured{};

inline SceneData only_materials(const pellucid::test::BsdfCase& c) {
  SceneData scene{};
  scene.materials = c.parts.data();
  return scene;
}

inline BsdfContext context_of(const pellucid::test::BsdfCase& c, int importance) {
  return {to_real3(c.wo), real(c.eta), importance};
}

inline BsdfEval evaluate(const pellucid::test::BsdfCase& c, int importance, real3 wi) {
  const SceneData scene = only_materials(c);
  return material_eval(&scene, c.material, context_of(c, importance), &untextured, real(c.side),
                       wi);
}

/// Draws with three multiples of 2^-24, as the kernels do.
inline BsdfSample draw(const pellucid::test::BsdfCase& c, int importance,
                       pellucid::test::Random& random) {
  const SceneData scene = only_materials(c);
  const real lobe = real(random.unit24()), u = real(random.unit24()), v = real(random.unit24());
  return material_sample(&scene, c.material, context_of(c, importance), &untextured, real(c.side),
                         lobe, u, v);
}

}  // namespace TWIN_NAMESPACE

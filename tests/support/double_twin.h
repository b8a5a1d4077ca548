// The double twin behind plain double types, so that tests of the float twin can ask it for
// densities, hits and paths.
#pragma once

#include <glm/glm.hpp>
#include <memory>

#include "pack/pack.h"
#include "support/bsdf_cases.h"

namespace pellucid::test {

struct ReferenceBsdf {
  glm::dvec3 f{0.0};
  double pdf = 0.0;
};
/// material_eval in double, as radiance; local directions.
ReferenceBsdf reference_bsdf(const BsdfCase& c, const glm::dvec3& wi);

struct ReferenceHit {
  double t = 0.0;
  uint prim = NONE;
};

/// A packed scene walked in double.
class ReferenceScene {
 public:
  explicit ReferenceScene(const PackedScene& packed);
  ~ReferenceScene();
  ReferenceHit trace(const glm::dvec3& o, const glm::dvec3& d) const;
  /// Density with which light_sample at p draws the direction w; 0 where no light is seen.
  double light_pdf(const glm::dvec3& p, const glm::dvec3& w) const;
  /// Radiance of the camera path (path, iteration, seed) through film position (x, y).
  glm::dvec3 path(const Launch& launch, uint path_index, double x, double y, uint* rays) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pellucid::test

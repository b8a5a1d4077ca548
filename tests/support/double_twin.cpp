// Compiled with PELLUCID_REAL=double only.
#include "support/double_twin.h"

#include "support/twin_bsdf.h"

namespace pellucid::test {

using twin::to_dvec3;
using twin::to_real3;

ReferenceBsdf reference_bsdf(const BsdfCase& c, const glm::dvec3& wi) {
  const twin::BsdfEval e = twin::evaluate(c, 0, to_real3(wi));
  return {to_dvec3(e.f), e.pdf_w};
}

struct ReferenceScene::State {
  const PackedScene& packed;
  std::vector<uint> diag;
  twin::SceneData data;
};

ReferenceScene::ReferenceScene(const PackedScene& packed) : state_(new State{packed, {}, {}}) {
  state_->data = twin::scene_data(packed, state_->diag);
}
ReferenceScene::~ReferenceScene() = default;

ReferenceHit ReferenceScene::trace(const glm::dvec3& o, const glm::dvec3& d) const {
  const twin::Ray ray =
      twin::make_ray(to_real3(o), to_real3(d), std::numeric_limits<double>::max());
  const twin::Hit hit = twin::bvh_trace(&state_->data, ray, 0);
  return {hit.t, hit.prim};
}

double ReferenceScene::light_pdf(const glm::dvec3& p, const glm::dvec3& w) const {
  const twin::Ray ray =
      twin::make_ray(to_real3(p), to_real3(w), std::numeric_limits<double>::max());
  const twin::Hit hit = twin::bvh_trace(&state_->data, ray, 0);
  if (hit.prim == NONE)
    return state_->data.info.environment == NONE ? 0.0 : twin::light_pdf_environment(&state_->data);
  const twin::Surface s = twin::surface_at(&state_->data, ray, hit);
  if (twin::is_black(twin::light_emitted(&state_->data, &s, -ray.d))) return 0.0;
  return twin::light_pdf_surface(&state_->data, s.light, s.p, s.ng, ray.o, ray.d);
}

glm::dvec3 ReferenceScene::path(const Launch& launch, uint path_index, double x, double y,
                                uint* rays) const {
  const twin::Rng rng{path_index, launch.iteration, launch.seed};
  const twin::Ray ray = twin::camera_ray(state_->packed.camera, x, y);
  twin::VertexStore store = twin::vertex_store_at(nullptr, nullptr, 0);
  double cut;
  return to_dvec3(twin::path_radiance(&state_->data, launch, rng, ray, 1.0, &store, rays, &cut));
}

}  // namespace pellucid::test

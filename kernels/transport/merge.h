// Merging: the light vertices within a radius of an eye path's vertex, taken for light that arrives
// at it [Georgiev12], [Hachisuka09], [Vorba11].
#ifndef PELLUCID_TRANSPORT_MERGE_H
#define PELLUCID_TRANSPORT_MERGE_H

#include "transport/grid.h"
#include "transport/stored_vertex.h"
#include "transport/walk.h"

/// What one light vertex brings to an eye vertex.
typedef struct Merge {
  real3 value;
  real weight;
} Merge;

/// The radiance that the photon brings to `eye` if they were one point, over `launch.merge_scale`.
/// Photons count power through the geometric surface; K / |wi.ng| makes radiance of it, with the
/// mean |cosine| of both facets: the photon's own has no bound on round surfaces, and by the eye's
/// alone shading normals would give photons from across an edge, which it sees graze, an infinite
/// mean. As the radius shrinks both are one; the error is of second order in it, as with either.
/// 0 where nothing is scattered.
INLINE int merge_photon(PRIVATE const SceneData* scene, Launch launch, PRIVATE const EndVertex* eye,
                        Photon photon, PRIVATE Merge* merge) {
  real3 ng = eye->v.surface.ng, wi = load3(photon.wi_dVCM);
  real3 photon_ng = REAL3(photon.ng_x, photon.ng_y, photon.ng_z);
  if (dot3(ng, photon_ng) < (real)MERGE_COS_MIN) return 0;
  // On a round sheet, light that grazes one side lies behind the tangent plane of a point beside
  // it: it stays on the side that it came to.
  real cos_g = dot3(ng, wi);
  real photon_cos_g = dot3(photon_ng, wi);
  if (!(cos_g * photon_cos_g > REAL(0.0))) return 0;
  BsdfEval e = vertex_eval(scene, &eye->v, wi);
  if (is_black(e.f)) return 0;
  real mean_cos_g = REAL(0.5) * (r_abs(cos_g) + r_abs(photon_cos_g));
  real scale = (real)launch.merge_scale / mean_cos_g;
  merge->value = eye->beta * e.f * load3(photon.beta_dVC) * scale;
  merge->weight = REAL(1.0);
#if INTG_PARTIALS
  real survive = (real)eye->v.material.survive;
  real reverse = vertex_pdf_reverse(scene, &eye->v, wi) * survive;
  Partials light = partials_start((real)photon.wi_dVCM.w, (real)photon.beta_dVC.w);
  light.trust = eye->partials.trust;
  real on_light = partials_merge(launch, light, e.pdf_w * survive);
  real on_eye = partials_merge(launch, eye->partials, reverse);
  merge->weight = partial_weight(launch.mis, on_light, on_eye);
#endif
  return 1;
}

#endif

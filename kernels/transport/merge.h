// Merging: the light vertices within a radius of an eye path's vertex, taken for light that arrives
// at it [Georgiev12], [Hachisuka09], [Vorba11].
#ifndef PELLUCID_TRANSPORT_MERGE_H
#define PELLUCID_TRANSPORT_MERGE_H

#include "transport/grid.h"
#include "transport/mis.h"
#include "transport/stored_vertex.h"
#include "transport/walk.h"

/// What one light vertex brings to an eye vertex.
typedef struct Merge {
  real3 value;
  real weight;
} Merge;

/// The radiance that the photon brings to `eye` if they were one point, over `launch.merge_scale`.
/// Photons count power through the geometric surface; K / |wi.ng| makes radiance of it. Not by the
/// photon's own normal: on round surfaces that ratio has no bound. Neither has that by the eye's
/// under shading normals, where photons come across an edge to a facet that their light grazes:
/// there by the mean of both cosines, which is as right on either side of an edge as from the
/// other. 0 where nothing is scattered.
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
  real cos_flux = r_abs(cos_g);
#if FEAT_SMOOTH_NORMALS
  if (eye->v.surface.flags & SHAPE_SMOOTH) cos_flux = REAL(0.5) * (cos_flux + r_abs(photon_cos_g));
#endif
  real scale = (real)launch.merge_scale / cos_flux;
  merge->value = eye->beta * e.f * load3(photon.beta_dVC) * scale;
  merge->weight = REAL(1.0);
#if INTG_PARTIALS
  real survive = (real)eye->v.material.survive;
  real reverse = vertex_pdf_reverse(scene, &eye->v, wi) * survive;
  Partials light = partials_start((real)photon.wi_dVCM.w, (real)photon.beta_dVC.w);
  light.trust = eye->partials.trust;
  real on_light = partials_merge(launch, light, e.pdf_w * survive);
  real on_eye = partials_merge(launch, eye->partials, reverse);
  merge->weight = mis_counted(scene, partial_weight(launch.mis, on_light, on_eye));
#endif
  return 1;
}

#endif

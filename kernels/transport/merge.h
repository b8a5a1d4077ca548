// Merging: the light vertices within a radius of an eye path's vertex, taken for light that arrives
// at it [Georgiev12], [Hachisuka09].
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

/// The radiance that `light` brings to `eye` if they were one point, over `launch.merge_scale`.
/// Light vertices count power through the geometric surface, f |wi.ns| / |wi.ng| makes radiance of
/// it. 0 where nothing is scattered.
INLINE int merge_vertices(PRIVATE const SceneData* scene, Launch launch,
                          PRIVATE const EndVertex* eye, PRIVATE const EndVertex* light,
                          PRIVATE Merge* merge) {
  real3 ng = eye->v.surface.ng;
  if (dot3(ng, light->v.surface.ng) < (real)MERGE_COS_MIN) return 0;
  real3 wi = to_world(light->v.frame, light->v.context.wo);
  real cos_wi;
  BsdfEval e = vertex_eval(scene, &eye->v, wi, &cos_wi);
  if (is_black(e.f)) return 0;
  real cos_g = r_abs(dot3(ng, wi));
  if (!(cos_g > REAL(0.0))) return 0;
  merge->value = eye->beta * e.f * light->beta * (cos_wi / cos_g * (real)launch.merge_scale);
  merge->weight = REAL(1.0);
#if INTG_CONNECT && INTG_MERGE
  real survive = (real)eye->v.material.survive;
  real reverse = vertex_pdf_reverse(scene, &eye->v, wi) * survive;
  real on_light = partials_merge(launch, light->partials, e.pdf_w * survive);
  real on_eye = partials_merge(launch, eye->partials, reverse);
  merge->weight = partial_weight(launch.mis, on_light, on_eye);
#endif
  return 1;
}

#endif

// Scattering at a surface point in world space: sidedness, shading frame, and the rule that light
// crosses the surface where the geometric normal says so.
#ifndef PELLUCID_TRANSPORT_VERTEX_H
#define PELLUCID_TRANSPORT_VERTEX_H

#include "core/frame.h"
#include "geom/surface.h"
#include "transport/material.h"

/// A vertex of a walk, met from direction wo (unit, pointing to where the walk came from).
typedef struct Vertex {
  Surface surface;
  Material material;
  Frame frame;          // shading frame flipped to the side of wo
  BsdfContext context;  // wo in that frame
  real side;            // +1: wo is in front of the geometric normal; -1: behind
  real cos_wo;          // |wo . ng|
  int black;            // one-sided surface met from behind, or wo in a tangent plane
} Vertex;

/// ns is flipped to wo independently of ng. A pair (wo, wi) then scatters the same way seen from
/// either end: both normals only have to agree on reflection or transmission.
INLINE Vertex vertex_at(PRIVATE const SceneData* scene, Surface surface, real3 wo, int importance) {
  Vertex v;
  v.surface = surface;
  v.material = scene->materials[surface.material];
#if FEAT_TEXTURE
  apply_texture(scene, &surface, &v.material);
#endif
  real cos_g = dot3(surface.ng, wo);
  real cos_s = dot3(surface.ns, wo);
  v.side = cos_g > REAL(0.0) ? REAL(1.0) : REAL(-1.0);
  v.cos_wo = r_abs(cos_g);
  v.frame = frame_from_normal(cos_s < REAL(0.0) ? -surface.ns : surface.ns);
  v.context.wo = to_local(v.frame, wo);
  v.context.importance = importance;
  v.context.eta = material_eta(v.material, v.side);
  // A broken normal or direction ends the walk, but not in silence.
  int broken = !is_finite(cos_g + cos_s);
  if (broken) diag_count(scene, DIAG_nonfinite_vertex);
  v.black = broken || cos_g == REAL(0.0) || v.context.wo.z <= REAL(0.0);
#if FEAT_ONE_SIDED
  v.black |= (surface.flags & SHAPE_ONE_SIDED) && v.side < REAL(0.0);
#endif
  return v;
}

/// Photons are gathered here: light scatters widely, so that those around stand for it.
INLINE int vertex_gathers(PRIVATE const Vertex* v) {
  return (v->material.lobes & (LOBE_SPREAD | LOBE_NARROW)) == LOBE_SPREAD;
}

/// Both normals agree whether wi is reflected or transmitted.
INLINE int vertex_sides_agree(PRIVATE const Vertex* v, real3 wi, real3 wi_local) {
  return dot3(v->surface.ng, wi) * v->side * wi_local.z > REAL(0.0);
}

/// What f is multiplied by towards wi. Radiance: the cosine to the shading normal. Importance
/// (walks from lights): shading normals are not symmetric, so its adjoint [Veach97 5.3.2], |wi.ng|
/// |wo.ns| / |wo.ng|, without bound where wo grazes the geometry.
INLINE real vertex_cosine(PRIVATE const Vertex* v, real3 wi, real3 wi_local) {
#if FEAT_SMOOTH_NORMALS
  if (v->context.importance) return r_abs(dot3(v->surface.ng, wi)) * v->context.wo.z / v->cos_wo;
#endif
  return r_abs(wi_local.z);
}

/// f and density for a world direction; 0 where the sides disagree. *cos_wi: see vertex_cosine.
INLINE BsdfEval vertex_eval(PRIVATE const SceneData* scene, PRIVATE const Vertex* v, real3 wi,
                            PRIVATE real* cos_wi) {
  real3 wi_local = to_local(v->frame, wi);
  *cos_wi = vertex_cosine(v, wi, wi_local);
  if (!vertex_sides_agree(v, wi, wi_local)) return bsdf_eval_none();
  return material_eval(scene, v->material, v->context, &v->surface, v->side, wi_local);
}

/// Density [1/sr] with which sampling, met from wi, draws wo; 0 where the sides disagree.
INLINE real vertex_pdf_reverse(PRIVATE const SceneData* scene, PRIVATE const Vertex* v, real3 wi) {
  real3 wi_local = to_local(v->frame, wi);
  if (!vertex_sides_agree(v, wi, wi_local)) return REAL(0.0);
  return material_pdf_reverse(scene, v->material, v->context, &v->surface, v->side, wi_local);
}

/// Draws a world direction by the BSDF. weight = 0 ends the walk.
INLINE BsdfSample vertex_sample(PRIVATE const SceneData* scene, PRIVATE const Vertex* v, real lobe,
                                real u1, real u2) {
  BsdfSample s =
      material_sample(scene, v->material, v->context, &v->surface, v->side, lobe, u1, u2);
  if (is_black(s.weight)) return s;
  real3 wi = to_world(v->frame, s.wi);
  if (!vertex_sides_agree(v, wi, s.wi)) return bsdf_sample_none();
#if FEAT_SMOOTH_NORMALS
  if (v->context.importance) s.weight = s.weight * (vertex_cosine(v, wi, s.wi) / r_abs(s.wi.z));
#endif
  s.wi = normalize3(wi);  // once per bounce, so that directions do not drift (numerics 33)
  return s;
}

/// Draws a world direction uniformly over the hemisphere of wo, or over the sphere if light passes
/// through. Delta lobes use their own sampling; beside others they take half of the walks, from
/// which whatever else that sampling finds is left out. For the `reference` method.
INLINE BsdfSample vertex_sample_uniform(PRIVATE const SceneData* scene, PRIVATE const Vertex* v,
                                        real lobe, real u1, real u2) {
  if (bsdf_is_delta(v->material)) return vertex_sample(scene, v, lobe, u1, u2);
  real share = REAL(1.0);  // of the walks that are drawn uniformly
  if (bsdf_has_delta(v->material)) {
    share = REAL(0.5);
    if (lobe >= share) {
      BsdfSample own = vertex_sample(scene, v, (lobe - share) / (REAL(1.0) - share), u1, u2);
      if (!own.delta) return bsdf_sample_none();
      own.weight = own.weight * (REAL(1.0) / (REAL(1.0) - share));
      return own;
    }
  }
  int whole = bsdf_is_transmissive(v->material);
  real3 wi = whole ? warp_sphere(u1, u2)
                   : to_world(frame_from_normal(v->surface.ng * v->side), warp_hemisphere(u1, u2));
  real cos_wi;
  BsdfEval e = vertex_eval(scene, v, wi, &cos_wi);
  BsdfSample s = bsdf_sample_none();
  s.wi = normalize3(wi);
  s.pdf_w = share * (whole ? INV_FOUR_PI : INV_TWO_PI);
  s.weight = e.f * (cos_wi / s.pdf_w);
  return s;
}

#endif

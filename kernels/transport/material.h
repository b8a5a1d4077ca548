// The material of a vertex: one dispatch over lobes, or a mix, whose parts are all evaluated and
// added up. A part is sampled with the probability of its weight, whichever end a walk comes from.
#ifndef PELLUCID_TRANSPORT_MATERIAL_H
#define PELLUCID_TRANSPORT_MATERIAL_H

#include "bsdf/albedo.h"
#include "bsdf/bsdf.h"
#include "geom/surface.h"
#include "geom/texture.h"

/// Index on the far side over the index on the side of wo; `side` > 0: wo is in front.
INLINE real material_eta(Material m, real side) {
  return side > REAL(0.0) ? (real)m.ior : REAL(1.0) / (real)m.ior;
}

#if FEAT_TEXTURE
/// The base colour times the texel. Roulette goes with the albedo of this very point, so that walks
/// from both ends agree; rounding it up keeps a white texel without effect: each of its three
/// roundings, and that of m->survive, is at most one unit.
INLINE void apply_texture(PRIVATE const SceneData* scene, PRIVATE const Surface* s,
                          PRIVATE Material* m) {
  if (!(s->flags & SHAPE_TEXTURED) || m->texture == NONE) return;
  real3 colour = load3(m->reflectance) * texture_at(scene, m->texture, s->u, s->v);
  m->reflectance.x = (float)colour.x;
  m->reflectance.y = (float)colour.y;
  m->reflectance.z = (float)colour.z;
  real albedo = (max3(colour) + (real)m->untextured) * (real)(1.0f + 8.0f * UNIT_ROUNDOFF);
  m->survive = (float)r_min((real)m->survive, albedo);
}
#endif

#if FEAT_MIX
INLINE uint mix_count(Material m) {
  return m.kind == MATERIAL_MIX ? m.part_count : 1u;
}
/// Part i, and in *c the context in which it scatters; a material that is no mix is its only part.
INLINE Material mix_part(PRIVATE const SceneData* scene, Material m, uint i,
                         PRIVATE const Surface* surface, real side, PRIVATE BsdfContext* c) {
  if (m.kind != MATERIAL_MIX) return m;
  Material part = scene->materials[m.first_part + i];
  c->eta = material_eta(part, side);
#if FEAT_TEXTURE
  apply_texture(scene, surface, &part);
#endif
  return part;
}

/// f and density of all parts but `except`.
INLINE BsdfEval mix_eval(PRIVATE const SceneData* scene, Material m, BsdfContext c,
                         PRIVATE const Surface* surface, real side, real3 wi, uint except) {
  BsdfEval sum = bsdf_eval_none();
  uint count = mix_count(m);
  for (uint i = 0; i < count; ++i) {
    if (i == except) continue;
    Material part = mix_part(scene, m, i, surface, side, &c);
    BsdfEval e = bsdf_eval(part, c, wi);
    sum.f += e.f * (real)part.weight;
    sum.pdf_w += e.pdf_w * (real)part.weight;
  }
  return sum;
}

/// Picks a part by `lobe`, samples it, and weighs the direction by all parts. A delta lobe has its
/// direction to itself, so there the weight of the part and its probability cancel.
INLINE BsdfSample mix_sample(PRIVATE const SceneData* scene, Material m, BsdfContext c,
                             PRIVATE const Surface* surface, real side, real lobe, real u, real v) {
  uint count = mix_count(m), i = 0;
  Material part = mix_part(scene, m, i, surface, side, &c);
  real rest = lobe;
  while (i + 1u < count && rest >= (real)part.weight) {
    rest -= (real)part.weight;
    part = mix_part(scene, m, ++i, surface, side, &c);
  }
  // Weights are rounded: their sum may fall short of `lobe` by a little.
  rest = r_min(rest / (real)part.weight, (real)(1.0f - UNIT_ROUNDOFF));
  BsdfSample s = bsdf_sample(part, c, rest, u, v);
  if (count == 1u || s.delta || s.pdf_w == REAL(0.0)) return s;
  BsdfEval others = mix_eval(scene, m, c, surface, side, s.wi, i);
  real own = s.pdf_w * (real)part.weight;
  s.pdf_w = others.pdf_w + own;
  s.weight = (others.f * r_abs(s.wi.z) + s.weight * own) * (REAL(1.0) / s.pdf_w);
  return s;
}
#endif

/// As bsdf_albedo, for any material.
INLINE real3 material_albedo(PRIVATE const SceneData* scene, Material m, BsdfContext c,
                             PRIVATE const Surface* surface, real side) {
#if FEAT_MIX
  real3 sum = REAL3(0.0f, 0.0f, 0.0f);
  for (uint i = 0; i < mix_count(m); ++i) {
    Material part = mix_part(scene, m, i, surface, side, &c);
    sum += bsdf_albedo(part) * (real)part.weight;
  }
  return sum;
#else
  return bsdf_albedo(m);
#endif
}

/// As bsdf_eval, for any material.
INLINE BsdfEval material_eval(PRIVATE const SceneData* scene, Material m, BsdfContext c,
                              PRIVATE const Surface* surface, real side, real3 wi) {
#if FEAT_MIX
  return mix_eval(scene, m, c, surface, side, wi, NONE);
#else
  return bsdf_eval(m, c, wi);
#endif
}

/// Density [1/sr] with which sampling draws wo where a walk comes from wi: both local to wo's
/// frame, which that walk has flipped if wi is on the other side.
INLINE real material_pdf_reverse(PRIVATE const SceneData* scene, Material m, BsdfContext c,
                                 PRIVATE const Surface* surface, real side, real3 wi) {
  real flip = wi.z < REAL(0.0) ? REAL(-1.0) : REAL(1.0);
  BsdfContext back = c;
  back.wo = REAL3(wi.x, wi.y, wi.z * flip);
  back.eta = flip < REAL(0.0) ? REAL(1.0) / c.eta : c.eta;
  real3 wo = REAL3(c.wo.x, c.wo.y, c.wo.z * flip);
  return material_eval(scene, m, back, surface, side * flip, wo).pdf_w;
}

/// As bsdf_sample, for any material.
INLINE BsdfSample material_sample(PRIVATE const SceneData* scene, Material m, BsdfContext c,
                                  PRIVATE const Surface* surface, real side, real lobe, real u,
                                  real v) {
#if FEAT_MIX
  return mix_sample(scene, m, c, surface, side, lobe, u, v);
#else
  return bsdf_sample(m, c, lobe, u, v);
#endif
}

#endif

// Scattering at a surface point in world space: sidedness, shading frame, and the rule that light
// crosses the surface where the geometric normal says so.
#ifndef PELLUCID_TRANSPORT_VERTEX_H
#define PELLUCID_TRANSPORT_VERTEX_H

#include "core/frame.h"
#include "geom/surface.h"
#include "transport/facet.h"
#include "transport/material.h"

/// A vertex of a walk, met from direction wo (unit, pointing to where the walk came from).
typedef struct Vertex {
  Surface surface;
  Material material;
  real3 wo;
  Frame frame;          // shading frame, its normal on the side of the facet where wo is
  BsdfContext context;  // wo in that frame; from the camera its image above the shading plane
#if FEAT_SMOOTH_NORMALS
  real3 ng;  // geometric normal on that side, in that frame
#endif
  real side;    // +1: wo is in front of the geometric normal; -1: behind
  real cos_wo;  // |wo . ng|
  int black;    // one-sided surface met from behind, or wo in a tangent plane
} Vertex;

/// Light crosses the surface where the geometric normal says so; see transport/facet.h for what the
/// shading normal says then.
INLINE Vertex vertex_at(PRIVATE const SceneData* scene, Surface surface, real3 wo, int importance) {
  Vertex v;
  v.surface = surface;
  v.wo = wo;
  v.material = scene->materials[surface.material];
#if FEAT_TEXTURE
  apply_texture(scene, &surface, &v.material);
#endif
  real cos_g = dot3(surface.ng, wo);
  v.side = cos_g > REAL(0.0) ? REAL(1.0) : REAL(-1.0);
  v.cos_wo = r_abs(cos_g);
  real flip = dot3(surface.ns, surface.ng) < REAL(0.0) ? -v.side : v.side;
  v.frame = frame_from_normal(surface.ns * flip);
  v.context.wo = to_local(v.frame, wo);
#if FEAT_SMOOTH_NORMALS
  v.ng = to_local(v.frame, surface.ng * v.side);
  if (!importance) v.context.wo = facet_unfolded(v.context.wo, REAL(1.0));
#endif
  v.context.importance = importance;
  v.context.eta = material_eta(v.material, v.side);
  // A broken normal or direction ends the walk, but not in silence.
  int broken = !is_finite(cos_g + v.context.wo.z);
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

#if FEAT_SMOOTH_NORMALS
/// The vertex's own direction and `wi` as ends of one path.
typedef struct VertexEnds {
  LightEnd light;
  real3 wo;     // on the camera's side
  real share;   // facet_share of the direction that wo stands for
  real cos_wi;  // |wi . ng|
} VertexEnds;

INLINE VertexEnds vertex_ends(PRIVATE const Vertex* v, real3 wi) {
  VertexEnds ends;
  real cos_g = dot3(v->surface.ng, wi) * v->side;
  real above = cos_g < REAL(0.0) ? REAL(-1.0) : REAL(1.0);
  real3 wi_local = to_local(v->frame, wi);
  ends.cos_wi = r_abs(cos_g);
  if (v->context.importance) {
    ends.light = facet_light_end(v->ng, v->context.wo, REAL(1.0));
    ends.wo = facet_unfolded(wi_local, above);
    ends.share = facet_share(facet_camera_end(v->ng, ends.wo, above), ends.cos_wi);
  } else {
    ends.light = facet_light_end(v->ng, wi_local, above);
    ends.wo = v->context.wo;
    ends.share = facet_share(facet_camera_end(v->ng, ends.wo, REAL(1.0)), v->cos_wo);
  }
  if (!(ends.cos_wi > REAL(0.0))) ends.light.images = 0;  // NaN, too
  return ends;
}

/// Turns the vertex to one image of the light's end: the context of its lobes, and the direction
/// that they are asked for.
INLINE real3 vertex_turn(PRIVATE const Vertex* v, real3 wo, real3 image, PRIVATE BsdfContext* c) {
  *c = v->context;
  if (!c->importance) return image;
  c->wo = image;
  return wo;
}

/// f |wi.ns| and density of the lobes for one image of the light's end.
INLINE BsdfEval vertex_eval_image(PRIVATE const SceneData* scene, PRIVATE const Vertex* v, real3 wo,
                                  real3 image) {
  BsdfContext c;
  real3 towards = vertex_turn(v, wo, image, &c);
  BsdfEval e = material_eval(scene, v->material, c, &v->surface, v->side, towards);
  e.f = e.f * r_abs(image.z);
  if (c.importance) e.pdf_w *= r_abs(image.z);
  return e;
}

/// Density of the way back of the lobes for one image of the light's end.
INLINE real vertex_reverse_image(PRIVATE const SceneData* scene, PRIVATE const Vertex* v, real3 wo,
                                 real3 image) {
  BsdfContext c;
  real3 towards = vertex_turn(v, wo, image, &c);
  real pdf_w = material_pdf_reverse(scene, v->material, c, &v->surface, v->side, towards);
  return c.importance ? pdf_w : pdf_w * r_abs(image.z);
}
#endif

/// K of transport/facet.h, f |wi.ns| where normals agree, and the density of wi. From a light: its
/// adjoint. 0 where the normals do not agree whether wi is reflected or transmitted.
INLINE BsdfEval vertex_eval(PRIVATE const SceneData* scene, PRIVATE const Vertex* v, real3 wi) {
#if FEAT_SMOOTH_NORMALS
  VertexEnds ends = vertex_ends(v, wi);
  if (ends.light.images == 0) return bsdf_eval_none();
  BsdfEval e = vertex_eval_image(scene, v, ends.wo, ends.light.wi);
  if (ends.light.images == 2) {
    BsdfEval image = vertex_eval_image(scene, v, ends.wo, ends.light.image);
    e.f += image.f;
    e.pdf_w += image.pdf_w;
  }
  if (v->context.importance) {
    e.f = e.f * (ends.cos_wi / v->cos_wo);
    e.pdf_w *= ends.share / ends.light.sum;
  }
  return e;
#else
  real3 wi_local = to_local(v->frame, wi);
  if (!(dot3(v->surface.ng, wi) * v->side * wi_local.z > REAL(0.0))) return bsdf_eval_none();
  BsdfEval e = material_eval(scene, v->material, v->context, &v->surface, v->side, wi_local);
  e.f = e.f * r_abs(wi_local.z);
  return e;
#endif
}

/// Density [1/sr] with which a walk from the other end, met from wi, draws wo; 0 where the normals
/// do not agree.
INLINE real vertex_pdf_reverse(PRIVATE const SceneData* scene, PRIVATE const Vertex* v, real3 wi) {
#if FEAT_SMOOTH_NORMALS
  VertexEnds ends = vertex_ends(v, wi);
  if (ends.light.images == 0) return REAL(0.0);
  real pdf_w = vertex_reverse_image(scene, v, ends.wo, ends.light.wi);
  if (ends.light.images == 2) pdf_w += vertex_reverse_image(scene, v, ends.wo, ends.light.image);
  return v->context.importance ? pdf_w : pdf_w * (ends.share / ends.light.sum);
#else
  real3 wi_local = to_local(v->frame, wi);
  if (!(dot3(v->surface.ng, wi) * v->side * wi_local.z > REAL(0.0))) return REAL(0.0);
  return material_pdf_reverse(scene, v->material, v->context, &v->surface, v->side, wi_local);
#endif
}

#if FEAT_SMOOTH_NORMALS
/// Mirrors what the lobe has drawn at an eye path's vertex to the right side of the facet; what
/// else leads there counts as well. s->wi stays local.
INLINE void vertex_mirror_sample(PRIVATE const SceneData* scene, PRIVATE const Vertex* v,
                                 PRIVATE BsdfSample* s) {
  real above = s->wi.z < REAL(0.0) ? REAL(-1.0) : REAL(1.0);
  real3 drawn = s->wi;
  LightEnd end = facet_light_end(v->ng, drawn, above);
  real3 other = end.image;
  real cos_g = dot3(v->ng, drawn) * above;
  if (cos_g < REAL(0.0)) s->wi = end.image;
  // Mirrored back, its image is the lower one, and both lie on the lobe's side.
  int two = other.z * above > REAL(0.0);
  if (s->delta) {
    // A walk from the light has to choose this image, and at the camera's end the right one.
    real share = facet_share(facet_camera_end(v->ng, v->context.wo, REAL(1.0)), v->cos_wo);
    real z = r_abs(drawn.z);
    s->reverse *= two ? share * z / (z + r_abs(other.z)) : share;
  } else if (two) {
    BsdfEval e = vertex_eval_image(scene, v, v->context.wo, other);
    s->weight = (s->weight * s->pdf_w + e.f) * (REAL(1.0) / (s->pdf_w + e.pdf_w));
    s->pdf_w += e.pdf_w;
  }
}

/// The sample of a walk from a light; `choice` in [0, 1) picks images. Its wi is local.
INLINE BsdfSample vertex_adjoint_sample(PRIVATE const SceneData* scene, PRIVATE const Vertex* v,
                                        real lobe, real u1, real u2, real choice) {
  BsdfContext c = v->context;
  LightEnd light = facet_light_end(v->ng, c.wo, REAL(1.0));
  real3 other = light.image;
  if (light.images == 2) {
    real share = c.wo.z / light.sum;
    if (choice < share) {
      choice = choice / share;
    } else {
      choice = (choice - share) / (REAL(1.0) - share);
      c.wo = light.image;
      other = light.wi;
    }
  }
  BsdfSample s = material_sample(scene, v->material, c, &v->surface, v->side, lobe, u1, u2);
  if (is_black(s.weight)) return s;
  real above = s.wi.z < REAL(0.0) ? REAL(-1.0) : REAL(1.0);
  CameraEnd camera = facet_camera_end(v->ng, s.wi, above);
  if (!(camera.cosine > REAL(0.0))) return bsdf_sample_none();
  real own = c.wo.z / light.sum;  // share of the image chosen
  real scale = camera.sum / (v->cos_wo * r_abs(s.wi.z));
  if (s.delta || light.images < 2) {
    s.weight = s.weight * (scale * light.sum);
    s.pdf_w *= own;
  } else {
    BsdfEval e = vertex_eval_image(scene, v, s.wi, other);
    real pdf_w = s.pdf_w * own + e.pdf_w / light.sum;
    s.weight = (s.weight * (s.pdf_w * c.wo.z) + e.f * r_abs(s.wi.z)) * (scale / pdf_w);
    s.pdf_w = pdf_w;
  }
  int image = choice * camera.sum >= camera.cosine && camera.image > REAL(0.0);
  real share = facet_share(camera, image ? camera.image : camera.cosine);
  s.pdf_w *= share;
  if (s.delta) s.reverse /= own * share;
  if (image) s.wi.z = -s.wi.z;
  return s;
}
#endif

/// Draws a world direction by the BSDF. weight = 0 ends the walk. `choice` in [0, 1), for walks
/// from lights alone.
INLINE BsdfSample vertex_sample(PRIVATE const SceneData* scene, PRIVATE const Vertex* v, real lobe,
                                real u1, real u2, real choice) {
  BsdfSample s;
#if FEAT_SMOOTH_NORMALS
  if (v->context.importance) {
    s = vertex_adjoint_sample(scene, v, lobe, u1, u2, choice);
  } else {
    s = material_sample(scene, v->material, v->context, &v->surface, v->side, lobe, u1, u2);
    if (!is_black(s.weight)) vertex_mirror_sample(scene, v, &s);
  }
  real cos_g = dot3(v->ng, s.wi);
#else
  s = material_sample(scene, v->material, v->context, &v->surface, v->side, lobe, u1, u2);
  real cos_g = s.wi.z;
#endif
  if (is_black(s.weight)) return s;
  s.wi = normalize3(to_world(v->frame, s.wi));  // once per bounce: no drift (numerics 33)
  // What grazes the facet may have come to its other side by rounding: no light through walls.
  if (!(dot3(v->surface.ng, s.wi) * v->side * cos_g > REAL(0.0))) return bsdf_sample_none();
  return s;
}

/// Draws a world direction uniformly over the hemisphere of wo, or over the sphere if light passes
/// through. Delta lobes use their own sampling; beside others they take half of the walks, from
/// which whatever else that sampling finds is left out. For the `reference` method.
INLINE BsdfSample vertex_sample_uniform(PRIVATE const SceneData* scene, PRIVATE const Vertex* v,
                                        real lobe, real u1, real u2) {
  if (bsdf_is_delta(v->material)) return vertex_sample(scene, v, lobe, u1, u2, REAL(0.0));
  real share = REAL(1.0);  // of the walks that are drawn uniformly
  if (bsdf_has_delta(v->material)) {
    share = REAL(0.5);
    if (lobe >= share) {
      real rest = (lobe - share) / (REAL(1.0) - share);
      BsdfSample own = vertex_sample(scene, v, rest, u1, u2, REAL(0.0));
      if (!own.delta) return bsdf_sample_none();
      own.weight = own.weight * (REAL(1.0) / (REAL(1.0) - share));
      return own;
    }
  }
  int whole = bsdf_is_transmissive(v->material);
  real3 wi = whole ? warp_sphere(u1, u2)
                   : to_world(frame_from_normal(v->surface.ng * v->side), warp_hemisphere(u1, u2));
  BsdfEval e = vertex_eval(scene, v, wi);
  BsdfSample s = bsdf_sample_none();
  s.wi = normalize3(wi);
  s.pdf_w = share * (whole ? INV_FOUR_PI : INV_TWO_PI);
  s.weight = e.f * (REAL(1.0) / s.pdf_w);
  return s;
}

#endif

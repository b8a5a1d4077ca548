// Walks from the lights: how they start, arrive and scatter. The loops over them are in the passes,
// which splat and store what they find.
#ifndef PELLUCID_TRANSPORT_LIGHT_WALK_H
#define PELLUCID_TRANSPORT_LIGHT_WALK_H

#include "camera/camera.h"
#include "light/emission.h"
#include "transport/mis.h"
#include "transport/walk.h"

typedef struct LightWalk {
  Walk walk;
  EmitSample start;
  uint depth;  // segments so far
} LightWalk;

INLINE LightWalk light_walk_from(EmitSample start) {
  LightWalk w;
  w.start = start;
  w.walk = walk_start(w.start.ray, w.start.beta);
  w.walk.p_prev = w.start.p;
  w.depth = 0u;
#if INTG_PARTIALS
  if (!w.start.delta && w.start.pdf > REAL(0.0))
    w.walk.partials = partials_start(REAL(0.0), w.start.cos_light / w.start.pdf);
#endif
  return w;
}

INLINE LightWalk light_walk_start(PRIVATE const SceneData* scene, Rng rng) {
  return light_walk_from(
      light_emit(scene, rng_words(rng, DIM_EMIT_POINT), rng4(rng, DIM_EMIT_DIRECTION)));
}

#if INTG_PARTIALS
/// The walk has come to the vertex, the last of `depth` segments.
INLINE void light_walk_arrive(PRIVATE const SceneData* scene, Launch launch, PRIVATE LightWalk* w,
                              PRIVATE const Vertex* v) {
  if (w->depth == 1u) {
    // Only here is NEE's density known: it may depend on where it looks from.
    real nee = emit_pdf_nee(scene, &w->start, v->surface.p);
    w->walk.partials = partials_start(nee / (w->start.pdf * v->cos_wo),
                                      partials_dVC(w->walk.partials) / v->cos_wo);
  } else {
    walk_arrive(v, &w->walk);
  }
#if INTG_MERGE
  w->walk.partials.trust = merge_trust(launch, 0, w->depth == 1u);
#endif
}
#endif

/// Traces the next segment. 0: it ends on nothing that scatters.
INLINE int light_walk_next(PRIVATE const SceneData* scene, Launch launch, PRIVATE LightWalk* w,
                           PRIVATE Vertex* v) {
  if (is_black(w->walk.beta)) return 0;
  ++w->walk.rays;
  ++w->depth;
  Hit hit = bvh_trace(scene, w->walk.ray, 0);
  if (hit.prim == NONE) {
    scene_left(scene);
    return 0;
  }
  *v = vertex_at(scene, surface_at(scene, w->walk.ray, hit), -w->walk.ray.d, 1);
  if (v->black) return 0;
#if INTG_PARTIALS
  light_walk_arrive(scene, launch, w, v);
#endif
  return 1;
}

/// What a vertex of a light path sends to the camera (s = number of its vertices, t = 1).
typedef struct CameraLink {
  real3 value;  // radiance of the pixel that sees it, visibility still to be seen
  real weight;
  real pdf_w;  // with which the camera draws this direction [1/sr]
  Ray ray;     // for visibility
} CameraLink;

/// For a vertex in front of the camera. 0 where nothing arrives.
INLINE int camera_link(PRIVATE const SceneData* scene, Launch launch, Camera camera,
                       PRIVATE const LightWalk* w, PRIVATE const Vertex* v,
                       PRIVATE CameraLink* link) {
  real3 d = load3(camera.origin) - v->surface.p;
  real d2 = dot3(d, d);
  real3 wi = d * (REAL(1.0) / r_sqrt(d2));
  BsdfEval e = vertex_eval(scene, v, wi);
  if (is_black(e.f)) return 0;
  // [Georgiev12 eq. 26]: what eye paths would have, by area, is what a pixel's average asks for.
  real pdf_w = camera_pdf_w(camera, -wi);
  real scale = pdf_w / (d2 * (real)launch.light_paths);
  link->value = w->walk.beta * e.f * scale;
  link->weight = REAL(1.0);
  link->pdf_w = pdf_w;
#if INTG_CONNECT
  real cos_g = r_abs(dot3(v->surface.ng, wi));
  real reverse = vertex_pdf_reverse(scene, v, wi) * (real)v->material.survive;
  Partials q = w->walk.partials;
#if INTG_MERGE
  q.trust = merge_trust(launch, 1, w->depth == 1u);
#endif
  real others = partials_end(launch, q, cos_g * scale, reverse);
  link->weight = mis_counted(scene, partial_weight(launch.mis, others, REAL(0.0)));
#endif
  return shadow_ray(&v->surface, wi, load3(camera.origin), &link->ray);
}

#endif

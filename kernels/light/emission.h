// Lights as starts of walks: a point, a direction, the power carried, and the densities of both.
#ifndef PELLUCID_LIGHT_EMISSION_H
#define PELLUCID_LIGHT_EMISSION_H

#include "light/light.h"

/// The first edge of a light walk.
typedef struct EmitSample {
  Ray ray;     // from the light; its origin clears the light's surface
  real3 p;     // on the light: surface lights and lights without extent
  real3 ng;    // surface lights: normal there
  real3 beta;  // radiance times cosine over `pdf`: power [W] of one walk if it were the only one
  real pdf;    // surface: [1/(m^2 sr)]; without extent: [1/sr]; at infinity: [1/m^2], times [1/sr]
               // for the environment. Pick included
  real cos_light;   // surface: |cosine| of the direction there; else 1
  uint light;       // index
  int delta;        // walks from the eye never find it by chance
  int at_infinity;  // `p` has no meaning
} EmitSample;

INLINE EmitSample emit_none(uint light) {
  EmitSample e;
  e.ray = make_ray(REAL3(0.0f, 0.0f, 0.0f), REAL3(0.0f, 0.0f, 1.0f), REAL_MAX);
  e.p = e.ng = REAL3(0.0f, 0.0f, 0.0f);
  e.beta = REAL3(0.0f, 0.0f, 0.0f);
  e.pdf = REAL(0.0);
  e.cos_light = REAL(1.0);
  e.light = light;
  e.delta = e.at_infinity = 0;
  return e;
}

#if FEAT_LIGHT_TRIANGLE || FEAT_LIGHT_SPHERE || FEAT_LIGHT_DISK
/// A surface light: a point by area; a direction by its cosine, on either side if both emit.
INLINE void emit_surface(PRIVATE const SceneData* scene, Light light, Random4 point,
                         Random4 direction, PRIVATE EmitSample* e) {
  Surface s = light_point(scene, light, point.y, point.z);
  int front = (s.flags & SHAPE_EMIT_FRONT) != 0u;
  if (front && (s.flags & SHAPE_EMIT_BACK)) front = direction.z < REAL(0.5);
  Frame frame = frame_from_normal(front ? s.ng : -s.ng);
  real3 w = warp_cosine_hemisphere(direction.x, direction.y);
  e->p = s.p;
  e->ng = s.ng;
  e->ray.d = normalize3(to_world(frame, w));
  e->ray.o = spawn_origin(s.p, s.ng, s.offset, e->ray.d);
  e->cos_light = r_abs(dot3(s.ng, e->ray.d));
  real per_cosine = light_pdf_emit_surface(scene, e->light, s.flags);
  e->pdf = per_cosine * e->cos_light;
  e->beta = load3(light.value) * (REAL(1.0) / per_cosine);
}
#endif

/// A light without extent; a spot's directions are uniform in its cone.
INLINE void emit_from_point(Light light, Random4 direction, PRIVATE EmitSample* e) {
  e->p = load3(light.position);
  e->delta = 1;
  real angle = point_light_angle(light);
  e->pdf = (real)light.prob_pick / angle;
  e->ray.o = e->p;
  e->ray.d = warp_sphere(direction.x, direction.y);
  real fall = REAL(1.0);
#if FEAT_LIGHT_SPOT
  if (light.kind == LIGHT_SPOT) {
    real x = direction.x * (real)light.axis.w;  // 1 - cos to the axis
    real r = r_sqrt(x * (REAL(2.0) - x));
    SinCos phi = sincos_2pi(direction.y);
    e->ray.d =
        to_world(frame_from_normal(load3(light.axis)), REAL3(r * phi.c, r * phi.s, REAL(1.0) - x));
    fall = spot_falloff(light, e->ray.d);
  }
#endif
  e->beta = load3(light.value) * (fall / e->pdf);
}

/// A light at infinity: from a point of the disc that the whole scene lies behind.
INLINE void emit_from_disc(PRIVATE const SceneData* scene, Light light, real3 w, real pdf_direction,
                           Random4 point, PRIVATE EmitSample* e) {
  real radius = (real)scene->info.center_radius.w;
  real3 across = to_world(frame_from_normal(w), warp_disk(point.y, point.z));
  e->ray.o = load3(scene->info.center_radius) + (across - w * (real)DISC_DISTANCE) * radius;
  e->ray.d = w;
  e->pdf = (real)light.prob_pick * pdf_direction * light_pdf_disc(scene);
  e->beta = load3(light.value) * (REAL(1.0) / e->pdf);
  e->at_infinity = 1;
}

/// Starts a walk at a light picked as light_sample picks it: by words x and w of `point`; y and z
/// place it, and `direction` turns it. beta = 0 where nothing leaves.
INLINE EmitSample light_emit(PRIVATE const SceneData* scene, U4 point, Random4 direction) {
  if (scene->info.light_count == 0u) return emit_none(NONE);
  EmitSample e = emit_none(light_pick(scene, point.x, point.w));
  Light light = scene->lights[e.light];
  Random4 u;
  u.x = u.w = REAL(0.0);
  u.y = rng_unit(point.y);
  u.z = rng_unit(point.z);
  switch (light.kind) {
#if FEAT_LIGHT_TRIANGLE || FEAT_LIGHT_SPHERE || FEAT_LIGHT_DISK
    case LIGHT_TRIANGLE:
    case LIGHT_SPHERE:
    case LIGHT_DISK:
      emit_surface(scene, light, u, direction, &e);
      break;
#endif
#if FEAT_LIGHT_POINT || FEAT_LIGHT_SPOT
    case LIGHT_POINT:
    case LIGHT_SPOT:
      emit_from_point(light, direction, &e);
      break;
#endif
#if FEAT_LIGHT_DIRECTIONAL
    case LIGHT_DIRECTIONAL:
      emit_from_disc(scene, light, load3(light.position), REAL(1.0), u, &e);
      e.delta = 1;
      break;
#endif
#if FEAT_LIGHT_ENVIRONMENT
    case LIGHT_ENVIRONMENT:
      emit_from_disc(scene, light, warp_sphere(direction.x, direction.y), INV_FOUR_PI, u, &e);
      break;
#endif
    default:
      break;
  }
  return e;
}

/// Density [area of the light: 1/m^2, at infinity: 1/sr, without extent: the pick] with which
/// light_sample at p draws the start of `e`, times what turns it into the density of the first edge
/// as `e.pdf` counts it: the NEE side of the ratio that starts a walk's dVCM.
INLINE real emit_pdf_nee(PRIVATE const SceneData* scene, PRIVATE const EmitSample* e, real3 p) {
  Light light = scene->lights[e->light];
#if FEAT_LIGHT_ENVIRONMENT
  if (light.kind == LIGHT_ENVIRONMENT) return light_pdf_environment(scene);
#endif
  if (e->at_infinity) return (real)light.prob_pick;
  if (e->delta) {
    real3 d = p - e->p;
    return (real)light.prob_pick * dot3(d, d);
  }
  return light_pdf_surface(scene, e->light, e->p, e->ng, p, -e->ray.d) * e->cos_light;
}

#endif

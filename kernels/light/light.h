// Lights: pick one, sample a direction towards it, and the density of that for a direction found by
// chance. Sampling and density share their formulas, so MIS weights add up.
#ifndef PELLUCID_LIGHT_LIGHT_H
#define PELLUCID_LIGHT_LIGHT_H

#include "core/frame.h"
#include "core/rng.h"
#include "core/warp.h"
#include "geom/surface.h"

/// One light sample as seen from a point.
typedef struct LightSample {
  real3 wi;        // unit, from the point to the light
  real3 target;    // end of the shadow ray (offset from the light's surface), if not at infinity
  real3 radiance;  // radiance; for delta lights irradiance on a plane facing the light
  real pdf_w;      // [1/sr] pick included; delta lights: the probability of the pick
#if INTG_CONNECT
  real emit;  // density with which a light walk starts along this edge, over that of this
              // sample: [1/m^2], without the cosine at the point (light/emission.h)
#endif
  uint aim;         // Ray.aim of the shadow ray
  int delta;        // point, spot or directional: cannot be found by chance
  int at_infinity;  // shadow ray goes on without end
} LightSample;

/// Radiance that the surface gives off along w (unit, away from it).
INLINE real3 light_emitted(PRIVATE const SceneData* scene, PRIVATE const Surface* s, real3 w) {
  uint side = dot3(s->ng, w) > REAL(0.0) ? SHAPE_EMIT_FRONT : SHAPE_EMIT_BACK;
  if (s->light == NONE || !(s->flags & side)) return REAL3(0.0f, 0.0f, 0.0f);
  return load3(scene->lights[s->light].value);
}

/// Light chosen by an alias table [Walker77]: slot from one 32-bit word, then the slot's own light
/// if another word says so, else its alias. Whole words, since with 24 bits a light among a million
/// would be picked some percent more or less often than prob_pick says.
INLINE uint light_pick(PRIVATE const SceneData* scene, uint slot_word, uint keep_word) {
  uint slot = high_word(slot_word, scene->info.light_count);
  real keep = (real)keep_word * WORD_STEP;
  return keep < (real)scene->lights[slot].value.w ? slot : scene->lights[slot].alias;
}

/// Cone under which a sphere is seen from p: false from inside (then its area is sampled instead).
/// 1 - cos is computed from sin^2, without cancellation however small the sphere (numerics 11).
INLINE int sphere_cone(F4 center_radius, real3 p, PRIVATE real* sin2_max,
                       PRIVATE real* one_minus_cos) {
  real3 to_center = load3(center_radius) - p;
  real d2 = dot3(to_center, to_center);
  real r = (real)center_radius.w;
  if (d2 <= r * r * (real)SPHERE_NEAR) return 0;
  *sin2_max = r * r / d2;
  *one_minus_cos = *sin2_max / (REAL(1.0) + r_sqrt(REAL(1.0) - *sin2_max));
  return 1;
}

/// Density [1/sr] of a point drawn uniformly by area, seen under distance^2 and |cosine| there.
INLINE real area_to_solid_angle(real distance2, real cos_light, real area) {
  return distance2 / (cos_light * area);
}

INLINE real triangle_area(PRIVATE const SceneData* scene, uint prim) {
  Triangle tri = scene->triangles[prim];
  real3 v0 = load3(scene->positions[tri.v0]);
  real scale;
  real3 n = scaled_normal(load3(scene->positions[tri.v1]) - v0,
                          load3(scene->positions[tri.v2]) - v0, &scale);
  return REAL(0.5) * length3(n) * scale * scale;
}

INLINE real surface_light_area(PRIVATE const SceneData* scene, Light light) {
  if (light.kind == LIGHT_TRIANGLE) return triangle_area(scene, light.prim);
  F4 c = scene->quadrics[light.prim - scene->info.triangle_count].center_radius;
  real r2 = (real)c.w * (real)c.w;
  return light.kind == LIGHT_SPHERE ? REAL(4.0) * PI * r2 : PI * r2;
}

/// Density [1/sr, pick included] with which light_sample at p draws the direction wi that ended on
/// point p_light, with normal ng, of the emitter `index`.
INLINE real light_pdf_surface(PRIVATE const SceneData* scene, uint index, real3 p_light, real3 ng,
                              real3 p, real3 wi) {
  Light light = scene->lights[index];
#if FEAT_LIGHT_SPHERE
  if (light.kind == LIGHT_SPHERE) {
    real sin2_max, one_minus_cos;
    F4 c = scene->quadrics[light.prim - scene->info.triangle_count].center_radius;
    if (sphere_cone(c, p, &sin2_max, &one_minus_cos))
      return (real)light.prob_pick / (TWO_PI * one_minus_cos);
  }
#endif
  real3 to_light = p_light - p;
  real cos_light = r_abs(dot3(ng, wi));
  return (real)light.prob_pick *
         area_to_solid_angle(dot3(to_light, to_light), cos_light, surface_light_area(scene, light));
}

/// Density of a direction that escaped to the environment.
INLINE real light_pdf_environment(PRIVATE const SceneData* scene) {
  return (real)scene->lights[scene->info.environment].prob_pick * INV_FOUR_PI;
}

/// Density [1/(m^2 sr), pick included] of a light walk's start at a point of an emitter, over the
/// cosine there: by area, and by the cosine over the sides that emit.
INLINE real light_pdf_emit_surface(PRIVATE const SceneData* scene, uint index, uint flags) {
  Light light = scene->lights[index];
  uint both = SHAPE_EMIT_FRONT | SHAPE_EMIT_BACK;
  real per_side = (flags & both) == both ? INV_TWO_PI : INV_PI;
  return (real)light.prob_pick * per_side / surface_light_area(scene, light);
}

/// Density [1/m^2] of a point of the disc from which lights at infinity send their walks: as wide
/// as the scene, facing the light.
INLINE real light_pdf_disc(PRIVATE const SceneData* scene) {
  real r = (real)scene->info.center_radius.w;
  return INV_PI / (r * r);
}

/// Finishes a sample at a point of an emitting surface; pdf_w is set where the caller left it 0.
INLINE void sample_surface_point(PRIVATE const SceneData* scene, Light light, real3 p,
                                 PRIVATE Surface* s, PRIVATE LightSample* out) {
  real3 d = s->p - p;
  real d2 = dot3(d, d);
  real inv = REAL(1.0) / r_sqrt(d2);
  out->wi = d * inv;
  real cos_light = -dot3(s->ng, out->wi);
  uint side = cos_light > REAL(0.0) ? SHAPE_EMIT_FRONT : SHAPE_EMIT_BACK;
  if (!(s->flags & side) || !(d2 > REAL(0.0))) return;
  out->radiance = load3(light.value);
  out->target = spawn_origin(s->p, s->ng, s->offset, -out->wi);
  if (out->pdf_w == REAL(0.0))
    out->pdf_w = (real)light.prob_pick *
                 area_to_solid_angle(d2, r_abs(cos_light), surface_light_area(scene, light));
#if INTG_CONNECT
  out->emit = light_pdf_emit_surface(scene, s->light, s->flags) / out->pdf_w;  // cosines cancel
#endif
}

/// A point of an emitting surface, uniform by area.
INLINE Surface light_point(PRIVATE const SceneData* scene, Light light, real u, real v) {
  Surface s;
#if FEAT_LIGHT_TRIANGLE
  if (light.kind == LIGHT_TRIANGLE) {
    Triangle tri = scene->triangles[light.prim];
    surface_shape(scene, tri.shape, light.prim, &s);
    s.flags &= ~SHAPE_SMOOTH;
    real3 b = warp_triangle(u, v);
    triangle_point(scene, tri, b.y, b.z, &s);
    return s;
  }
#endif
  Quadric q = scene->quadrics[light.prim - scene->info.triangle_count];
  surface_shape(scene, q.shape, light.prim, &s);
  if (light.kind == LIGHT_SPHERE) {
    sphere_point(q.center_radius, warp_sphere(u, v), &s);
  } else {
    real3 offset = warp_disk(u, v) * (real)q.center_radius.w;
    disk_point(q, load3(q.center_radius) + to_world(frame_from_normal(load3(q.normal)), offset),
               &s);
  }
  return s;
}

/// Triangles and disks, by area.
INLINE void sample_area_light(PRIVATE const SceneData* scene, Light light, real3 p, U4 words,
                              PRIVATE LightSample* out) {
  Surface s = light_point(scene, light, rng_unit(words.y), rng_unit(words.z));
  sample_surface_point(scene, light, p, &s, out);
}

INLINE void sample_sphere_light(PRIVATE const SceneData* scene, Light light, real3 p, U4 words,
                                PRIVATE LightSample* out) {
  real u = rng_unit(words.y), v = rng_unit(words.z);
  Quadric q = scene->quadrics[light.prim - scene->info.triangle_count];
  Surface s;
  real sin2_max, one_minus_cos;
  if (sphere_cone(q.center_radius, p, &sin2_max, &one_minus_cos)) {
    // Angle alpha at the centre between the axis and the point seen under theta [PBRT4 6.2.4].
    real x = u * one_minus_cos;  // 1 - cos(theta)
    real cos_theta = REAL(1.0) - x;
    real sin2_theta = x * (REAL(2.0) - x);
    real cos_alpha =
        sin2_theta / r_sqrt(sin2_max) + cos_theta * safe_sqrt(REAL(1.0) - sin2_theta / sin2_max);
    real sin_alpha = safe_sqrt((REAL(1.0) - cos_alpha) * (REAL(1.0) + cos_alpha));
    SinCos phi = sincos_2pi(v);
    Frame frame = frame_from_normal(normalize3(p - load3(q.center_radius)));
    real3 n = normalize3(to_world(frame, REAL3(sin_alpha * phi.c, sin_alpha * phi.s, cos_alpha)));
    out->pdf_w = (real)light.prob_pick / (TWO_PI * one_minus_cos);
    // Nothing of a sphere lies before the point seen; at the rim rounding may say otherwise.
    out->aim = light.prim + 1u;
    surface_shape(scene, q.shape, light.prim, &s);
    sphere_point(q.center_radius, n, &s);
  } else {
    s = light_point(scene, light, u, v);
  }
  sample_surface_point(scene, light, p, &s, out);
}

/// Intensity of a spot towards unit w over that in its middle: 1 within the inner cone, 0 beyond
/// the outer, between them a cubic of the cosine [PBRT4 12.2.1]. Angles are held as 1 - cos, which
/// keeps its digits in narrow cones.
INLINE real spot_falloff(Light light, real3 w) {
  real3 off = w - load3(light.axis);
  real x = REAL(0.5) * dot3(off, off);
  real inner = (real)light.position.w, outer = (real)light.axis.w;
  if (x <= inner) return REAL(1.0);
  if (x >= outer) return REAL(0.0);
  real t = (outer - x) / (outer - inner);
  return t * t * (REAL(3.0) - REAL(2.0) * t);
}

/// Solid angle [sr] that a light without extent shines into, over 4 pi for points.
INLINE real point_light_angle(Light light) {
#if FEAT_LIGHT_SPOT
  if (light.kind == LIGHT_SPOT) return TWO_PI * (real)light.axis.w;
#endif
  return FOUR_PI;
}

/// A light without extent: point or spot.
INLINE void sample_point_light(Light light, real3 p, PRIVATE LightSample* out) {
  real3 d = load3(light.position) - p;
  real d2 = dot3(d, d);
  if (!(d2 > REAL(0.0))) return;
  out->wi = d * (REAL(1.0) / r_sqrt(d2));
  out->target = load3(light.position);
  out->radiance = load3(light.value) * (REAL(1.0) / d2);
  out->pdf_w = (real)light.prob_pick;
#if INTG_CONNECT
  out->emit = REAL(1.0) / (point_light_angle(light) * d2);
#endif
  out->delta = 1;
}

/// A light at infinity, in direction wi drawn with density pdf_w.
INLINE void sample_infinite_light(PRIVATE const SceneData* scene, Light light, real3 wi, real pdf_w,
                                  PRIVATE LightSample* out) {
  out->wi = wi;
  out->radiance = load3(light.value);
  out->pdf_w = (real)light.prob_pick * pdf_w;
#if INTG_CONNECT
  out->emit = light_pdf_disc(scene);
#endif
  out->at_infinity = 1;
}

/// Samples one light from p: words x and w pick it, y and z its point. radiance = 0 where the
/// sample carries nothing.
INLINE LightSample light_sample(PRIVATE const SceneData* scene, real3 p, U4 words) {
  LightSample out;
  out.wi = REAL3(0.0f, 0.0f, 1.0f);
  out.target = p;
  out.radiance = REAL3(0.0f, 0.0f, 0.0f);
  out.pdf_w = REAL(0.0);
#if INTG_CONNECT
  out.emit = REAL(0.0);
#endif
  out.aim = 0;
  out.delta = out.at_infinity = 0;
  if (scene->info.light_count == 0u) return out;
  Light light = scene->lights[light_pick(scene, words.x, words.w)];
  switch (light.kind) {
#if FEAT_LIGHT_TRIANGLE
    case LIGHT_TRIANGLE:
      sample_area_light(scene, light, p, words, &out);
      break;
#endif
#if FEAT_LIGHT_SPHERE
    case LIGHT_SPHERE:
      sample_sphere_light(scene, light, p, words, &out);
      break;
#endif
#if FEAT_LIGHT_DISK
    case LIGHT_DISK:
      sample_area_light(scene, light, p, words, &out);
      break;
#endif
#if FEAT_LIGHT_POINT
    case LIGHT_POINT:
      sample_point_light(light, p, &out);
      break;
#endif
#if FEAT_LIGHT_SPOT
    case LIGHT_SPOT:
      sample_point_light(light, p, &out);
      out.radiance = out.radiance * spot_falloff(light, -out.wi);
      break;
#endif
#if FEAT_LIGHT_DIRECTIONAL
    case LIGHT_DIRECTIONAL:
      sample_infinite_light(scene, light, -load3(light.position), REAL(1.0), &out);
      out.delta = 1;
      break;
#endif
#if FEAT_LIGHT_ENVIRONMENT
    case LIGHT_ENVIRONMENT:
      sample_infinite_light(scene, light, warp_sphere(rng_unit(words.y), rng_unit(words.z)),
                            INV_FOUR_PI, &out);
      break;
#endif
    default:
      break;
  }
  return out;
}

#endif

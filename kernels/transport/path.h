// Paths from the camera: `naive`, `nee`, `path` and `reference` as one walk whose parts are
// compiled in by INTG_NEE (light samples), INTG_MIS (weigh them against chance) and INTG_UNIFORM.
#ifndef PELLUCID_TRANSPORT_PATH_H
#define PELLUCID_TRANSPORT_PATH_H

#include "core/rng.h"
#include "light/light.h"
#include "transport/mis.h"
#include "transport/vertex.h"

/// State of a walk between two surfaces.
typedef struct Walk {
  Ray ray;
  real3 beta;      // throughput
  real3 radiance;  // gathered so far
  real3 p_prev;    // last vertex, from which NEE would have drawn
  real pdf_w;  // density of ray.d by the walk, survival included; 0 after delta or at the camera
  uint rays;
} Walk;

/// Weight of emission that the walk found by chance; `pdf_light` is NEE's density for the same
/// direction.
INLINE real chance_weight(Launch launch, PRIVATE const Walk* walk, real pdf_light) {
#if INTG_MIS
  return walk->pdf_w == REAL(0.0) ? REAL(1.0) : mis_weight(launch.mis, walk->pdf_w, pdf_light, 0);
#elif INTG_NEE
  return walk->pdf_w == REAL(0.0) ? REAL(1.0) : REAL(0.0);
#else
  return REAL(1.0);
#endif
}

/// Adds what a path brought: `value` unweighted, found by strategy `s` (vertices drawn from the
/// light's end) as a path of `depth` segments.
INLINE void walk_gather(PRIVATE Walk* walk, real3 value, real weight, uint s, uint depth) {
  walk->radiance += value * weight;
}

/// The ray left the scene.
INLINE void walk_escaped(PRIVATE const SceneData* scene, Launch launch, uint depth,
                         PRIVATE Walk* walk) {
#if FEAT_LIGHT_ENVIRONMENT
  if (scene->info.environment == NONE) return;  // compiled in by --features only
  real w = chance_weight(launch, walk, light_pdf_environment(scene));
  walk_gather(walk, walk->beta * load3(scene->lights[scene->info.environment].value), w, 0u, depth);
#endif
}

/// The ray hit a surface that emits towards it.
INLINE void walk_emission(PRIVATE const SceneData* scene, Launch launch, PRIVATE const Surface* s,
                          uint depth, PRIVATE Walk* walk) {
#if FEAT_LIGHT_TRIANGLE || FEAT_LIGHT_SPHERE || FEAT_LIGHT_DISK
  real3 emitted = light_emitted(scene, s, -walk->ray.d);
  if (is_black(emitted)) return;
  real pdf_light = REAL(0.0);
#if INTG_MIS
  if (walk->pdf_w > REAL(0.0)) pdf_light = light_pdf_surface(scene, s, walk->p_prev, walk->ray.d);
#endif
  walk_gather(walk, walk->beta * emitted, chance_weight(launch, walk, pdf_light), 0u, depth);
#endif
}

/// Next event estimation: one light sample from the vertex.
INLINE void walk_nee(PRIVATE const SceneData* scene, Launch launch, Rng rng, uint bounce,
                     PRIVATE const Vertex* v, PRIVATE Walk* walk) {
#if INTG_NEE
  LightSample light = light_sample(scene, v->surface.p, rng_words(rng, DIM_LIGHT(bounce)));
  if (is_black(light.radiance)) return;
  real cos_wi;
  BsdfEval e = vertex_eval(scene, v, light.wi, &cos_wi);
  if (is_black(e.f)) return;
  Ray shadow;
  shadow.o = spawn_origin(v->surface.p, v->surface.ng, v->surface.offset, light.wi);
  shadow.d = light.wi;
  shadow.t_max = REAL_MAX;
  shadow.aim = light.aim;
  if (!light.at_infinity) {
    real3 d = light.target - shadow.o;
    real dist2 = dot3(d, d);
    if (!(dist2 > REAL(0.0))) return;
    real dist = r_sqrt(dist2);
    shadow.d = d * (REAL(1.0) / dist);
    // The target already lies off the light; 4 roundoffs keep the length itself from crossing it.
    shadow.t_max = dist * (REAL(1.0) - (real)(4.0f * UNIT_ROUNDOFF));
  }
  ++walk->rays;
  if (bvh_trace(scene, shadow, 1).prim != NONE) return;
  real w = REAL(1.0);
#if INTG_MIS
  if (!light.delta) w = mis_weight(launch.mis, light.pdf_w, e.pdf_w * (real)v->material.survive, 1);
#endif
  walk_gather(walk, walk->beta * e.f * light.radiance * (cos_wi / light.pdf_w), w, 1u, bounce + 2u);
#endif
}

/// Scatters at the vertex: roulette by the material's own survival probability (local, so that a
/// walk from the other end knows it too), then a direction. 0 ends the walk.
INLINE int walk_scatter(PRIVATE const SceneData* scene, Rng rng, uint bounce,
                        PRIVATE const Vertex* v, PRIVATE Walk* walk) {
  Random4 u = rng4(rng, DIM_BSDF(bounce));
#if INTG_UNIFORM
  real survive = (real)REFERENCE_SURVIVE;
#else
  real survive = (real)v->material.survive;
#endif
  if (u.w >= survive) return 0;
#if INTG_UNIFORM
  BsdfSample s = vertex_sample_uniform(scene, v, u.x, u.y, u.z);
#else
  BsdfSample s = vertex_sample(scene, v, u.x, u.y, u.z);
#endif
  if (is_black(s.weight)) return 0;
  walk->beta *= s.weight * (REAL(1.0) / survive);
  walk->pdf_w = s.delta ? REAL(0.0) : s.pdf_w * survive;
  walk->p_prev = v->surface.p;
  walk->ray.o = spawn_origin(v->surface.p, v->surface.ng, v->surface.offset, s.wi);
  walk->ray.d = s.wi;
  return 1;
}

/// Radiance [W/(m^2 sr)] along a camera ray; *rays receives the number of rays traced.
INLINE real3 path_radiance(PRIVATE const SceneData* scene, Launch launch, Rng rng, Ray camera_ray,
                           PRIVATE uint* rays) {
  Walk walk;
  walk.ray = camera_ray;
  walk.beta = REAL3(1.0f, 1.0f, 1.0f);
  walk.radiance = REAL3(0.0f, 0.0f, 0.0f);
  walk.p_prev = camera_ray.o;
  walk.pdf_w = REAL(0.0);
  walk.rays = 0;
  uint limit = launch.max_depth < DEPTH_HARD_LIMIT ? launch.max_depth : DEPTH_HARD_LIMIT;
  for (uint depth = 1; depth <= limit; ++depth) {
    ++walk.rays;
    Hit hit = bvh_trace(scene, walk.ray, 0);
    if (hit.prim == NONE) {
      walk_escaped(scene, launch, depth, &walk);
      break;
    }
    Surface surface = surface_at(scene, walk.ray, hit);
    walk_emission(scene, launch, &surface, depth, &walk);
    if (depth == limit) {
      if (launch.max_depth > limit) diag_count(scene, DIAG_path_stuck);
      break;
    }
    Vertex v = vertex_at(scene, surface, -walk.ray.d, 0);
    if (v.black) break;
    uint bounce = depth - 1u;
    if (!bsdf_is_delta(v.material)) walk_nee(scene, launch, rng, bounce, &v, &walk);
    if (!walk_scatter(scene, rng, bounce, &v, &walk)) break;
  }
  *rays = walk.rays;
  return walk.radiance;
}

#endif

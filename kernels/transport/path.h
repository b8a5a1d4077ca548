// Paths from the camera: `naive`, `nee`, `path`, `reference` and the eye's side of all methods that
// walk from both ends, as one walk. Its parts are compiled in by INTG_NEE (light samples), INTG_MIS
// (weigh them against chance), INTG_UNIFORM, INTG_VERTICES (keep vertices), INTG_PARTIALS (weigh
// against all strategies), INTG_SEEN and INTG_GATHER.
#ifndef PELLUCID_TRANSPORT_PATH_H
#define PELLUCID_TRANSPORT_PATH_H

#include "camera/camera.h"
#include "light/light.h"
#include "transport/mis.h"
#include "transport/stored_vertex.h"
#include "transport/walk.h"

/// Weight of emission that the walk found by chance with its segment number `depth`; `pdf_light` is
/// NEE's density for the same direction, `emit` that of a light walk to start along it, over the
/// cosine at the light.
INLINE real chance_weight(Launch launch, PRIVATE const Walk* walk, uint depth, real pdf_light,
                          real emit) {
#if INTG_PARTIALS
  // Quantities from before the arrival: its distance and cosine cancel against the light's side.
  if (depth == 1u) return REAL(1.0);
  real by_nee = REAL(0.0);
#if INTG_NEE
  by_nee = pdf_light * walk->partials.dVCM;
#endif
  return partial_weight(launch.mis, by_nee, emit * partials_dVC_emission(walk->partials));
#elif INTG_MIS
  return walk->pdf_w == REAL(0.0) ? REAL(1.0) : mis_weight(launch.mis, walk->pdf_w, pdf_light, 0);
#elif INTG_NEE
  return walk->pdf_w == REAL(0.0) ? REAL(1.0) : REAL(0.0);
#else
  return REAL(1.0);
#endif
}

/// Light that a walk found.
typedef struct Found {
  real3 value;  // unweighted
  real weight;
  uint s, depth;        // vertices drawn from the light's end; segments of the whole path
  real3 p, wi;          // where it is (or nowhere: an environment), and its direction
  real pdf_w, pdf_nee;  // densities [1/sr] of finding it by chance and by a light sample; 0: never
} Found;

/// Adds what a path brought.
INLINE void walk_gather(PRIVATE const SceneData* scene, PRIVATE Walk* walk, Found found) {
  real3 brought = found.value * mis_counted(scene, found.weight);
  walk->radiance += brought;
#if INTG_LAYERS
  layer_add(walk->layers, found.value, found.weight, found.s, found.depth);
#endif
#if INTG_RECORD
  PathEvent e = record_event(scene, found.s ? EVENT_NEE : EVENT_EMISSION, found.depth - found.s);
  e.s = found.s;
  e.t = found.depth + 1u - found.s;
  e.p = record_row(found.p, 0.0f);
  e.d = record_row(found.wi, found.pdf_w);
  e.value.w = (float)found.pdf_nee;
  record_brought(scene, e, found.value, found.weight, brought);
#endif
}

/// The ray left the scene.
INLINE void walk_escaped(PRIVATE const SceneData* scene, Launch launch, uint depth,
                         PRIVATE Walk* walk) {
#if FEAT_LIGHT_ENVIRONMENT
  if (scene->info.environment == NONE) return;  // compiled in by --features only
  real pdf_light = light_pdf_environment(scene);
  Found found;
  found.value = walk->beta * load3(scene->lights[scene->info.environment].value);
  found.weight = chance_weight(launch, walk, depth, pdf_light, pdf_light * light_pdf_disc(scene));
  found.s = 0u;
  found.depth = depth;
  found.p = walk->ray.o;
  found.wi = walk->ray.d;
  found.pdf_w = walk->pdf_w;
  found.pdf_nee = pdf_light;
  walk_gather(scene, walk, found);
#endif
}

/// The ray hit a surface that emits towards it.
INLINE void walk_emission(PRIVATE const SceneData* scene, Launch launch, PRIVATE const Surface* s,
                          uint depth, PRIVATE Walk* walk) {
#if FEAT_LIGHT_TRIANGLE || FEAT_LIGHT_SPHERE || FEAT_LIGHT_DISK
  real3 emitted = light_emitted(scene, s, -walk->ray.d);
  if (is_black(emitted)) return;
  real pdf_light = REAL(0.0), emit = REAL(0.0);
#if INTG_MIS
  if (walk->pdf_w > REAL(0.0))
    pdf_light = light_pdf_surface(scene, s->light, s->p, s->ng, walk->p_prev, walk->ray.d);
#endif
#if INTG_PARTIALS
  emit = light_pdf_emit_surface(scene, s->light, s->flags);
#endif
  Found found;
  found.value = walk->beta * emitted;
  found.weight = chance_weight(launch, walk, depth, pdf_light, emit);
  found.s = 0u;
  found.depth = depth;
  found.p = s->p;
  found.wi = walk->ray.d;
  found.pdf_w = walk->pdf_w;
  found.pdf_nee = pdf_light;
  walk_gather(scene, walk, found);
#endif
}

/// Weight of the light sample `light` from the vertex, whose BSDF says `e` towards it.
INLINE real nee_weight(PRIVATE const SceneData* scene, Launch launch, PRIVATE const Vertex* v,
                       PRIVATE const Walk* walk, PRIVATE const LightSample* light, BsdfEval e) {
#if INTG_CONNECT
  real survive = (real)v->material.survive;
  Partials q = walk->partials;
#if INTG_MERGE
  q.trust = merge_trust(launch, 0, 1);
#endif
  real by_chance = light->delta ? REAL(0.0) : e.pdf_w * survive / light->pdf_w;
  real cos_g = r_abs(dot3(v->surface.ng, light->wi));
  return partial_weight(launch.mis, by_chance,
                        partials_end(launch, q, light->emit * cos_g,
                                     vertex_pdf_reverse(scene, v, light->wi) * survive));
#elif INTG_MIS
#if INTG_GATHER
  if (vertex_gathers(v)) return REAL(1.0);  // nobody goes on from here to find light by chance
#endif
  if (light->delta) return REAL(1.0);
  return mis_weight(launch.mis, light->pdf_w, e.pdf_w * (real)v->material.survive, 1);
#else
  return REAL(1.0);
#endif
}

/// Next event estimation: one light sample from the vertex.
INLINE void walk_nee(PRIVATE const SceneData* scene, Launch launch, Rng rng, uint bounce,
                     PRIVATE const Vertex* v, PRIVATE Walk* walk) {
#if INTG_NEE
  LightSample light = light_sample(scene, v->surface.p, rng_words(rng, DIM_LIGHT(bounce)));
  if (is_black(light.radiance)) return;
  BsdfEval e = vertex_eval(scene, v, light.wi);
  if (is_black(e.f)) return;
  Ray shadow;
  if (light.at_infinity) {
    real3 o = spawn_origin(v->surface.p, v->surface.ng, v->surface.offset, light.wi);
    shadow = make_ray(o, light.wi, REAL_MAX);
  } else if (!shadow_ray(&v->surface, light.wi, light.target, &shadow)) {
    return;
  }
  shadow.aim = light.aim;
  ++walk->rays;
  if (bvh_trace(scene, shadow, 1).prim != NONE) return;
  Found found;
  found.value = walk->beta * e.f * light.radiance * (REAL(1.0) / light.pdf_w);
  found.weight = nee_weight(scene, launch, v, walk, &light, e);
  found.s = 1u;
  found.depth = bounce + 2u;
  found.p = light.at_infinity ? shadow.o : light.target;
  found.wi = light.wi;
  found.pdf_w = light.delta ? REAL(0.0) : e.pdf_w * (real)v->material.survive;
  found.pdf_nee = light.pdf_w;
  walk_gather(scene, walk, found);
#endif
}

#if INTG_RADIUS
/// At the first vertex kept: the radius over the width that a pixel has after so long a path.
INLINE void walk_put_radius(Launch launch, PRIVATE Walk* walk) {
  if (walk->spread == REAL(0.0)) return;
  layer_radius(walk->layers, (float)((real)launch.radius / (walk->spread * walk->length)));
  walk->spread = REAL(0.0);
}
#endif

/// Keeps the vertex for connections and merging, as far as path length allows any.
INLINE void walk_keep(PRIVATE VertexStore* store, Launch launch, uint depth,
                      PRIVATE const Vertex* v, PRIVATE Walk* walk) {
#if INTG_PARTIALS
  walk_arrive(v, walk);
#endif
#if INTG_VERTICES
#if INTG_GATHER
  if (!vertex_gathers(v)) return;
#else
  if (bsdf_is_delta(v->material)) return;
#endif
  if (depth + (INTG_NEE ? 2u : 1u) > launch.max_depth) return;  // light samples end the others
  vertex_store(store, v, walk->beta, walk->partials, depth);
#if INTG_RADIUS
  walk_put_radius(launch, walk);
#endif
#endif
}

/// From this vertex on delta lobes alone are followed: other methods see to the rest.
INLINE int walk_ends_spread(PRIVATE const Vertex* v) {
#if INTG_SEEN
  return 1;
#elif INTG_GATHER
  return vertex_gathers(v);
#else
  return 0;
#endif
}

/// Radiance [W/(m^2 sr)] along a camera ray; *rays receives the number of rays traced, *cut the
/// throughput with which --max-depth kept it from going on. `store` takes the vertices that light
/// paths will be connected to (unused without INTG_VERTICES).
INLINE real3 path_radiance(PRIVATE const SceneData* scene, Launch launch, Rng rng, Ray camera_ray,
                           real pdf_camera,
#if INTG_LAYERS
                           LayerSink layers,
#endif
                           PRIVATE VertexStore* store, PRIVATE uint* rays, PRIVATE real* cut) {
  Walk walk = walk_start(camera_ray, REAL3(1.0f, 1.0f, 1.0f));
#if INTG_PARTIALS
  walk.partials = partials_from_camera(launch, pdf_camera);
#endif
#if INTG_LAYERS
  walk.layers = layers;
#endif
  record_start(scene, camera_ray, pdf_camera, walk.beta);
#if INTG_RADIUS
  walk.spread = REAL(1.0) / r_sqrt(pdf_camera);
#endif
  uint limit = depth_limit(launch);
  *cut = REAL(0.0);
  for (uint depth = 1; depth <= limit; ++depth) {
    ++walk.rays;
    Hit hit = bvh_trace(scene, walk.ray, 0);
    if (hit.prim == NONE) {
      scene_left(scene);
      walk_escaped(scene, launch, depth, &walk);
      break;
    }
    Surface surface = surface_at(scene, walk.ray, hit);
#if INTG_RADIUS
    walk.length += length3(surface.p - walk.p_prev);
#endif
    walk_emission(scene, launch, &surface, depth, &walk);
    int last = depth == limit;  // it scatters once more, but only to know what is cut off
    if (last && launch.max_depth > limit) {
      diag_count(scene, DIAG_path_stuck);
      break;
    }
    Vertex v = vertex_at(scene, surface, -walk.ray.d, 0);
    if (v.black) break;
    uint bounce = depth - 1u;
    if (!last) {
      walk_keep(store, launch, depth, &v, &walk);
      walk_record(scene, depth, &v, &walk);
      if (!bsdf_is_delta(v.material)) walk_nee(scene, launch, rng, bounce, &v, &walk);
    }
    int delta_only = walk_ends_spread(&v);
    if (delta_only && !bsdf_has_delta(v.material)) break;
    if (!walk_scatter(scene, launch, rng, DIM_BSDF(bounce), &v, &walk)) break;
    if (!last) record_scatter(scene, depth, walk.ray, walk.pdf_w, walk.beta);
    if (delta_only && walk.pdf_w > REAL(0.0)) break;
    if (last) *cut = mean3(walk.beta);
  }
  *rays = walk.rays;
  return walk.radiance;
}

#endif

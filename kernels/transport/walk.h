// A walk between two surfaces, from the camera or from a light: its state, how it scatters, and the
// rays that connect its vertices to other points.
#ifndef PELLUCID_TRANSPORT_WALK_H
#define PELLUCID_TRANSPORT_WALK_H

#include "core/rng.h"
#include "film/layers.h"
#include "transport/record.h"

/// Emitters seen directly or through delta surfaces alone: what light tracing leaves to the camera.
#define INTG_SEEN (INTG_SPLAT && !INTG_CONNECT)
/// Vertices of sub-paths are kept, to be connected or merged.
#define INTG_VERTICES (INTG_CONNECT || INTG_MERGE)
/// `sppm`: the eye path gathers at its first vertex that scatters widely, and goes on from there
/// through delta lobes alone.
#define INTG_GATHER (INTG_MERGE && !INTG_PARTIALS)
/// Eye paths tell how many pixels wide the radius of merging is.
#define INTG_RADIUS (INTG_MERGE && INTG_LAYERS)

typedef struct Walk {
  Ray ray;
  real3 beta;      // throughput; from a light: power [W]
  real3 radiance;  // gathered so far
  real3 p_prev;    // last vertex
  real pdf_w;  // density of ray.d by the walk, survival included; 0 after delta or at the camera
#if INTG_VERTICES
  Partials partials;
#endif
#if INTG_LAYERS
  LayerSink layers;  // of the pixel of a walk from the camera
#endif
#if INTG_RADIUS
  real length;  // of the path from the camera
  real spread;  // width of a pixel's beam at a length of 1; 0 once a vertex is kept
#endif
  uint rays;
} Walk;

INLINE Walk walk_start(Ray ray, real3 beta) {
  Walk walk;
  walk.ray = ray;
  walk.beta = beta;
  walk.radiance = REAL3(0.0f, 0.0f, 0.0f);
  walk.p_prev = ray.o;
  walk.pdf_w = REAL(0.0);
#if INTG_VERTICES
  walk.partials = partials_start(REAL(0.0), REAL(0.0));
#endif
#if INTG_RADIUS
  walk.length = walk.spread = REAL(0.0);
#endif
  walk.rays = 0;
  return walk;
}

/// Most segments of a path, and of each of its sub-paths.
INLINE uint depth_limit(Launch launch) {
  return launch.max_depth < DEPTH_HARD_LIMIT ? launch.max_depth : DEPTH_HARD_LIMIT;
}

#if INTG_PARTIALS
/// The walk has come to the vertex.
INLINE void walk_arrive(PRIVATE const Vertex* v, PRIVATE Walk* walk) {
  real3 d = v->surface.p - walk->p_prev;
  partials_arrive(&walk->partials, dot3(d, d), v->cos_wo);
}

/// It leaves the vertex by the sample drawn there.
INLINE void walk_leave(PRIVATE const SceneData* scene, Launch launch, PRIVATE const Vertex* v,
                       BsdfSample s, PRIVATE Walk* walk) {
  real cos_g = r_abs(dot3(v->surface.ng, s.wi));
  if (s.delta) {
    partials_scatter_delta(&walk->partials, s.reverse, cos_g);
  } else {
    real survive = (real)v->material.survive;
    real reverse = vertex_pdf_reverse(scene, v, s.wi) * survive;
    partials_scatter(launch, &walk->partials, s.pdf_w * survive, reverse, cos_g);
  }
#if INTG_MERGE
  if (!s.delta) walk->partials.trust = merge_trust(launch, 0, 0);
#endif
}
#endif

/// Writes the vertex down that the walk has come to.
INLINE void walk_record(PRIVATE const SceneData* scene, uint depth, PRIVATE const Vertex* v,
                        PRIVATE const Walk* walk) {
#if INTG_PARTIALS
  record_vertex(scene, depth, v, walk->beta, walk->partials.dVCM, partials_dVC(walk->partials));
#else
  record_vertex(scene, depth, v, walk->beta, REAL(0.0), REAL(0.0));
#endif
}

/// Scatters at the vertex: roulette by the material's own survival probability (local, so that a
/// walk from the other end knows it too), then a direction by the numbers of `dimension`. 0 ends
/// the walk.
INLINE int walk_scatter(PRIVATE const SceneData* scene, Launch launch, Rng rng, uint dimension,
                        PRIVATE const Vertex* v, PRIVATE Walk* walk) {
  Random4 u = rng4(rng, dimension);
#if INTG_UNIFORM
  real survive = (real)REFERENCE_SURVIVE;
#else
  real survive = (real)v->material.survive;
#endif
  if (u.w >= survive) return 0;
#if INTG_UNIFORM
  BsdfSample s = vertex_sample_uniform(scene, v, u.x, u.y, u.z);
#else
  BsdfSample s = vertex_sample(scene, v, u.x, u.y, u.z, u.w / survive);
#endif
  if (is_black(s.weight)) return 0;
  walk->beta *= s.weight * (REAL(1.0) / survive);
  walk->pdf_w = s.delta ? REAL(0.0) : s.pdf_w * survive;
#if INTG_PARTIALS
  walk_leave(scene, launch, v, s, walk);
#endif
  walk->p_prev = v->surface.p;
  walk->ray.o = spawn_origin(v->surface.p, v->surface.ng, v->surface.offset, s.wi);
  walk->ray.d = s.wi;
  return 1;
}

/// Ray from the surface towards `target`, a point that already clears what it lies on, along about
/// `wi`. 0: it would have no length.
INLINE int shadow_ray(PRIVATE const Surface* s, real3 wi, real3 target, PRIVATE Ray* ray) {
  *ray = make_ray(spawn_origin(s->p, s->ng, s->offset, wi), wi, REAL_MAX);
  real3 d = target - ray->o;
  real dist2 = dot3(d, d);
  if (!(dist2 > REAL(0.0))) return 0;
  real dist = r_sqrt(dist2);
  ray->d = d * (REAL(1.0) / dist);
  // The target clears what it lies on by roundoffs of its coordinates, which may be next to 0, but
  // distances are off by roundoffs of their own: with 4 taken off, one ray in 200 to a light about
  // the origin ended on that light; with 6, three in 1e6, with 8 none of 1e7.
  ray->t_max = dist * (REAL(1.0) - (real)(16.0f * UNIT_ROUNDOFF));
  return 1;
}

#endif

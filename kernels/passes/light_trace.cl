// light_trace: walks from the lights. Each vertex with a spread lobe is splatted to the pixel that
// sees it, and stored for connections and merging.
// Reads: scene, filter. Writes: splats [pixels of the tile], light_vertices, light_last,
// light_first (their number) [paths of the launch], vertex_counts, layers, record, diag. Domain:
// light paths of the launch. Atomics: splats, vertex_counts, layers, record, diag. Next:
// vertex_scan, or film_add. Flags: INTG_SPLAT, INTG_CONNECT, INTG_MERGE, INTG_NEE, INTG_COMPACT,
// INTG_LAYERS, INTG_RECORD, INTG_SOBOL, INTG_FILTER.
#include "film/layers.h"
#include "passes/bundles.h"
#include "transport/light_walk.h"
#include "transport/stored_vertex.h"

/// The vertex as the camera sees it.
INLINE void splat_vertex(PRIVATE const SceneData* scene, Launch launch, Camera camera,
                         __global const float* filter_table, __global const float* filter_values,
                         __global uint* splats,
#if INTG_LAYERS
                         __global uint* layers,
#endif
                         Rng rng, PRIVATE LightWalk* w, PRIVATE const Vertex* v) {
  FilmPosition at;
  if (!camera_project(camera, v->surface.p, &at)) return;
  int x, y;
  real weight = 1.0f, reach = 0.0f;
#if INTG_FILTER
  reach = filter_table[0];
#endif
  if (!(at.x > -reach && at.x < (real)launch.width + reach)) return;
  if (!(at.y > -reach && at.y < (real)launch.height + reach)) return;
#if INTG_FILTER
  real weight_y;
  Random4 u = rng4(rng, DIM_LIGHT_WALK_SPLAT(w->depth));
  x = filter_pixel(filter_table, filter_values, at.x, u.x, &weight);
  y = filter_pixel(filter_table, filter_values, at.y, u.y, &weight_y);
  weight *= weight_y;
#else
  x = (int)floor(at.x);
  y = (int)floor(at.y);
#endif
  CameraLink link;
  if (!film_in_window(launch, x, y) || !camera_link(scene, launch, camera, w, v, &link)) return;
  ++w->walk.rays;  // though another band may be the one to trace it
  if (!film_in_tile(launch, x, y)) return;
  if (bvh_trace(scene, link.ray, 1).prim != NONE) return;
  real3 value = link.value * (link.weight * weight);
  film_splat(splats, scene->diag, launch, x, y, value.x, value.y, value.z);
#if INTG_RECORD
  PathEvent e = record_event(scene, EVENT_SPLAT, w->depth);
  e.s = w->depth + 1u;
  e.t = 1u;
  e.p = record_row(v->surface.p, 0.0f);
  e.d = record_row(link.ray.d, link.pdf_w);
  record_brought(scene, e, link.value * weight, link.weight, value);
#endif
#if INTG_LAYERS
  uint s = w->depth + 1u;
  layer_splat(layers, scene->diag, launch, x, y, link.value * weight, link.weight, s, s);
  layer_vertex(layers, scene->diag, launch, x, y);
#endif
}

#if INTG_VERTICES
/// Whether anything can be made of the vertex, as far as path length allows.
INLINE int light_vertex_kept(Launch launch, PRIVATE const Vertex* v, uint depth) {
#if INTG_GATHER
  return vertex_gathers(v) && depth > 1u;  // light samples bring the first
#else
  return depth + (INTG_MERGE ? 1u : 2u) <= launch.max_depth;
#endif
}
#endif

__kernel void light_trace(SCENE_PARAMS FILTER_PARAMS SPLAT_PARAMS
#if INTG_VERTICES
                              LIGHT_VERTEX_PARAMS VERTEX_COUNT_PARAMS
#endif
#if INTG_LAYERS
                                  LAYER_PARAMS
#endif
                                      RECORD_PARAMS DIAG_PARAMS const Launch launch) {
  uint index = work_item(launch);
  if (index >= launch.path_count) return;
  SCENE_FROM_PARAMS
  Rng rng;
  rng.path = launch.path_first + index;
  rng.iteration = launch.iteration;
  rng.seed = launch.seed;
  int splatted = rng.path >= launch.splat_first && rng.path < launch.splat_end;
#if INTG_VERTICES
  int stored = rng.path >= launch.store_first && rng.path < launch.store_end;
  VertexStore store = vertex_store_at(light_vertices, &vertex_counts[0], launch.light_capacity);
#endif
  RECORDER(rng.path, 1u, splatted && rng.path == launch.record_path, 1)
  LightWalk w = light_walk_start(&scene_data, rng);
  record_start(&scene_data, w.walk.ray, w.start.pdf, w.walk.beta);
  Vertex v;
  uint limit = depth_limit(launch);
  int capped = launch.max_depth == limit;
  // With a limit of 1 it may not even start.
  real cut = capped && limit == 1u && !is_black(w.walk.beta) ? REAL(1.0) : REAL(0.0);
  while (w.depth + 1u < limit && light_walk_next(&scene_data, launch, &w, &v)) {
    walk_record(&scene_data, w.depth, &v, &w.walk);
    if (!bsdf_is_delta(v.material)) {
#if INTG_SPLAT
      if (splatted)
        splat_vertex(&scene_data, launch, camera, filter_table, filter_values, splats,
#if INTG_LAYERS
                     layers,
#endif
                     rng, &w, &v);
#endif
#if INTG_VERTICES
      if (stored && light_vertex_kept(launch, &v, w.depth))
        vertex_store(&store, &v, w.walk.beta, w.walk.partials, w.depth);
#endif
    }
    if (w.depth + 1u == limit && launch.max_depth > limit) diag_count(&scene_data, DIAG_path_stuck);
    if (!walk_scatter(&scene_data, launch, rng, DIM_LIGHT_WALK_BSDF(w.depth - 1u), &v, &w.walk))
      break;
    record_scatter(&scene_data, w.depth, w.walk.ray, w.walk.pdf_w, w.walk.beta);
    if (capped && w.depth + 1u == limit) cut = mean3(w.walk.beta) / mean3(w.start.beta);
  }
#if INTG_VERTICES
  light_last[index] = store.last;
  light_first[index] = store.count;
#endif
  if (splatted && film_count_rays(splats, diag, launch, rng.path, w.walk.rays))
    cut_add(diag, CUT_light, cut);
}

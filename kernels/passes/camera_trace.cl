// camera_trace: one eye path per pixel of a slice: emission that it meets, light samples, and
// vertices stored for connections and merging.
// Reads: scene, filter. Writes: samples [pixels of the tile], eye_vertices, eye_last, eye_first
// (their number) [pixels of the slice], vertex_counts, layers, record, diag. Domain: pixels of
// the slice. Atomics: vertex_counts, layers, record, diag. Next: vertex_scan, or film_add.
// Flags: INTG_NEE, INTG_MIS, INTG_SPLAT, INTG_CONNECT, INTG_MERGE, INTG_COMPACT, INTG_LAYERS,
// INTG_RECORD, INTG_SOBOL, INTG_FILTER.
#include "passes/bundles.h"
#include "passes/tile.h"
#include "transport/path.h"

__kernel void camera_trace(SCENE_PARAMS FILTER_PARAMS FILM_PARAMS
#if INTG_VERTICES
                               EYE_VERTEX_PARAMS VERTEX_COUNT_PARAMS
#endif
#if INTG_LAYERS
                                   LAYER_PARAMS
#endif
                                       RECORD_PARAMS DIAG_PARAMS const Launch launch) {
  uint index = work_item(launch);
  if (index >= launch.slice_count) return;
  SCENE_FROM_PARAMS
  uint pixel = launch.slice_first + index;
  TileSample s = tile_sample(launch, camera, filter_table, pixel);
#if INTG_VERTICES
  VertexStore store = vertex_store_at(eye_vertices, &vertex_counts[1], launch.eye_capacity);
#else
  VertexStore store = vertex_store_at(0, 0, 0u);
#endif
#if INTG_LAYERS
  LayerSink sink = layer_sink(layers, diag, launch, pixel);
  if (pixel < launch.gather_first) sink.set = 0u;  // traced again, for its vertices alone
#endif
  RECORDER(s.rng.path, 0u, 1, pixel >= launch.gather_first)
  uint rays;
  real cut;
  real3 radiance = path_radiance(&scene_data, launch, s.rng, s.ray, camera_pdf_w(camera, s.ray.d),
#if INTG_LAYERS
                                 sink,
#endif
                                 &store, &rays, &cut);
  if (pixel >= launch.gather_first) {
    samples[pixel] = (float4)(radiance.x, radiance.y, radiance.z, (float)rays);
    cut_add(diag, CUT_camera, cut);
  }
#if INTG_VERTICES
  eye_last[index] = store.last;
  eye_first[index] = store.count;
#endif
}

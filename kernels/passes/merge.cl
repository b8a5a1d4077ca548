// merge: gathers the light vertices around every vertex of a pixel's eye path.
// Reads: scene, eye vertices with their order, photon_positions, photons, grid_cells. Writes:
// samples [pixels of the tile] (adds), layers, record, diag. Domain: pixels of the slice. Atomics:
// layers, record, diag. Next: film_add. Flags: INTG_MERGE, INTG_NEE, INTG_CONNECT, INTG_COMPACT,
// INTG_LAYERS, INTG_RECORD.
#include "passes/bundles.h"
#if INTG_MERGE
#include "transport/merge.h"

/// Sum over the photons around one vertex.
INLINE real3 merge_around(PRIVATE const SceneData* scene, Launch launch,
                          __global const F4* photon_positions, __global const Photon* photons,
                          __global const uint* grid_cells,
#if INTG_LAYERS
                          LayerSink sink,
#endif
#if INTG_RECORD
                          __global const uint* grid_pairs,
#endif
                          PRIVATE const EndVertex* eye) {
  real3 sum = (float3)(0.0f);
  GridSearch search = grid_search(launch, grid_cells, eye->v.surface.p);
  for (;;) {
    uint i = grid_next(launch, photon_positions, grid_cells, &search);
    if (i == NONE) return sum;
#if INTG_LAYERS
    layer_photon(sink);
#endif
    Photon photon = photons[i];
    uint depth = eye->depth + photon.depth;
    if (depth > launch.max_depth) continue;
    Merge merge;
    if (!merge_photon(scene, launch, eye, photon, &merge)) continue;
    sum += merge.value * merge.weight;
#if INTG_RECORD
    PathEvent e = record_event(scene, EVENT_MERGE, eye->depth);
    e.partner = grid_pairs[2 * (size_t)i + 1u];
    e.s = photon.depth + 1u;
    e.t = eye->depth + 1u;
    e.p = record_row(load3(photon_positions[i]), 0.0f);
    e.d = record_row(load3(photon.wi_dVCM), 0.0f);
    record_brought(scene, e, merge.value, merge.weight, merge.value * merge.weight);
#endif
#if INTG_LAYERS
    layer_merge(sink, merge.value, merge.weight, eye->depth, depth);
#endif
  }
}

#if INTG_LAYERS
/// Paints the pixel by the cell around p as it is in the first pass, when cells are largest: they
/// have other borders in every pass.
INLINE void paint_cell(Launch launch, __global const F4* photon_positions,
                       __global const uint* grid_cells, real3 p, LayerSink sink) {
  if (!(layer_kinds(sink.set) & LAYERS_CELLS) || launch.iteration > 0u) return;
  GridCell cell = grid_cell(launch, p);
  uint bucket = grid_bucket(launch, cell), own = 0u;
  uint begin = grid_cells[2 * bucket], end = grid_cells[2 * bucket + 1u];
  for (uint i = begin; i < end; ++i) {
    GridCell at = grid_cell(launch, load3(photon_positions[i]));
    if (at.x == cell.x && at.y == cell.y && at.z == cell.z) ++own;
  }
  layer_cell(sink, own, end - begin, 1u + ((uint)(cell.x ^ cell.y ^ cell.z) & 1u));
}
#endif

__kernel void merge(SCENE_PARAMS FILM_PARAMS EYE_VERTEX_PARAMS GRID_PARAMS
#if INTG_LAYERS
                        LAYER_PARAMS
#endif
                            RECORD_PARAMS DIAG_PARAMS const Launch launch) {
  uint index = work_item(launch);
  if (index >= launch.slice_count) return;
  SCENE_FROM_PARAMS
  uint pixel = launch.slice_first + index;
  RECORDER((launch.tile_y + pixel / launch.tile_width) * launch.width + launch.tile_x +
               pixel % launch.tile_width,
           0u, 0, 1)
  real3 sum = (float3)(0.0f);
  for (uint i = eye_first[index]; i < eye_first[index + 1u]; ++i) {
    __global const StoredVertex* eye_at = (__global const StoredVertex*)eye_vertices;
    EndVertex eye = vertex_unpack(&scene_data, eye_at[eye_order[i]], 0);
    // Vertices are packed: what grazed a surface may come back from behind it.
    if (eye.v.black) continue;
#if INTG_PARTIALS
    int first = eye.partials.trust > REAL(0.0);
    if (!first && launch.mis_deep == 0.0f) continue;
    eye.partials.trust = merge_trust(launch, first, 0);
#endif
#if INTG_LAYERS
    LayerSink sink = layer_sink(layers, diag, launch, pixel);
    sink.first = i == eye_first[index];
    if (sink.first) paint_cell(launch, photon_positions, grid_cells, eye.v.surface.p, sink);
#endif
    sum += merge_around(&scene_data, launch, photon_positions, photons, grid_cells,
#if INTG_LAYERS
                        sink,
#endif
#if INTG_RECORD
                        grid_pairs,
#endif
                        &eye);
  }
  samples[pixel] += (float4)(sum, 0.0f);
}
#endif

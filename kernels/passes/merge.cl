// merge: gathers the light vertices around every vertex of a pixel's eye path.
// Reads: scene, eye vertices with their order, photon_positions, photons, grid_cells. Writes:
// samples [pixels of the tile] (adds), diag. Domain: pixels of the slice. Atomics: diag only. Next:
// film_add. Flags: INTG_CONNECT, INTG_COMPACT.
#include "passes/bundles.h"
#include "transport/merge.h"

/// Sum over the photons around one vertex.
INLINE real3 merge_around(PRIVATE const SceneData* scene, Launch launch,
                          __global const F4* photon_positions, __global const Photon* photons,
                          __global const uint* grid_cells,
#if INTG_LAYERS
                          LayerSink sink,
#endif
                          PRIVATE const EndVertex* eye) {
  real3 sum = (float3)(0.0f);
  GridSearch search = grid_search(launch, grid_cells, eye->v.surface.p);
  for (;;) {
    uint i = grid_next(launch, photon_positions, grid_cells, &search);
    if (i == NONE) return sum;
    Photon photon = photons[i];
    uint depth = eye->depth + photon.depth;
    if (depth > launch.max_depth) continue;
#if INTG_GATHER
    if (photon.depth == 1u) continue;  // light samples have brought it
#endif
    Merge merge;
    if (!merge_photon(scene, launch, eye, photon, &merge)) continue;
    sum += merge.value * merge.weight;
#if INTG_LAYERS
    layer_merge(sink, merge.value, merge.weight, eye->depth, depth);
#endif
  }
}

__kernel void merge(SCENE_PARAMS FILM_PARAMS LIGHT_VERTEX_PARAMS EYE_VERTEX_PARAMS GRID_PARAMS
#if INTG_LAYERS
                        LAYER_PARAMS
#endif
                            DIAG_PARAMS const Launch launch) {
  uint index = (uint)get_global_id(0);
  if (index >= launch.slice_count) return;
  SCENE_FROM_PARAMS
  uint pixel = launch.slice_first + index;
  real3 sum = (float3)(0.0f);
  for (uint i = eye_first[index]; i < eye_first[index + 1u]; ++i) {
    __global const StoredVertex* eye_at = (__global const StoredVertex*)eye_vertices;
    EndVertex eye = vertex_unpack(&scene_data, eye_at[eye_order[i]], 0);
    sum += merge_around(&scene_data, launch, photon_positions, photons, grid_cells,
#if INTG_LAYERS
                        layer_sink(layers, diag, launch, pixel),
#endif
                        &eye);
  }
  samples[pixel] += (float4)(sum, 0.0f);
}

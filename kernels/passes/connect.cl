// connect: joins each vertex of a pixel's eye path with each of the light path paired with it.
// Reads: scene, light and eye vertices with their order. Writes: samples [pixels of the tile]
// (adds), layers, record, diag. Domain: pixels of the slice. Atomics: layers, record, diag. Next:
// film_add.
// Flags: INTG_CONNECT, INTG_MERGE, INTG_NEE, INTG_COMPACT, INTG_LAYERS, INTG_RECORD.
#include "passes/bundles.h"
#include "shared/pairing.h"
#include "transport/connect.h"

__kernel void connect(SCENE_PARAMS FILM_PARAMS LIGHT_VERTEX_PARAMS EYE_VERTEX_PARAMS
#if INTG_LAYERS
                          LAYER_PARAMS
#endif
                              RECORD_PARAMS DIAG_PARAMS const Launch launch) {
  uint index = work_item(launch);
  if (index >= launch.slice_count) return;
  SCENE_FROM_PARAMS
  uint pixel = launch.slice_first + index;
  uint column = launch.tile_x + pixel % launch.tile_width;
  uint row = launch.tile_y + pixel / launch.tile_width;
  uint path = paired_light_path(row * launch.width + column, launch.width * launch.height,
                                launch.light_paths) -
              launch.path_first;
  uint light_end = light_first[path + 1u];
  RECORDER(row * launch.width + column, 0u, 0, 1)
  real3 sum = (float3)(0.0f);
  uint rays = 0u;
  for (uint i = eye_first[index]; i < eye_first[index + 1u]; ++i) {
    __global const StoredVertex* eye_at = (__global const StoredVertex*)eye_vertices;
    EndVertex eye = vertex_unpack(&scene_data, eye_at[eye_order[i]], 0);
#if INTG_MERGE
    eye.partials.trust = merge_trust(launch, eye.partials.trust > REAL(0.0), 0);
#endif
    for (uint j = light_first[path]; j < light_end; ++j) {
      __global const StoredVertex* light_at = (__global const StoredVertex*)light_vertices;
      EndVertex light = vertex_unpack(&scene_data, light_at[light_order[j]], 1);
      if (eye.depth + light.depth + 1u > depth_limit(launch)) break;
      Connection link;
      if (!connect_vertices(&scene_data, launch, &eye, &light, &link)) continue;
      ++rays;
      if (bvh_trace(&scene_data, link.ray, 1).prim != NONE) continue;
      sum += link.value * link.weight;
#if INTG_RECORD
      PathEvent e = record_event(&scene_data, EVENT_CONNECT, eye.depth);
      e.partner = path + launch.path_first;
      e.s = light.depth + 1u;
      e.t = eye.depth + 1u;
      e.p = record_row(light.v.surface.p, 0.0f);
      e.d = record_row(link.ray.d, 0.0f);
      record_brought(&scene_data, e, link.value, link.weight, link.value * link.weight);
#endif
#if INTG_LAYERS
      layer_add(layer_sink(layers, diag, launch, pixel), link.value, link.weight, light.depth + 1u,
                eye.depth + light.depth + 1u);
#endif
    }
  }
  samples[pixel] += (float4)(sum, (float)rays);
}

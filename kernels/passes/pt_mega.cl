// pt_mega: one camera path per pixel, whole.
// Reads: scene, filter. Writes: samples [pixels], layers, record, diag. Domain: pixels. Atomics:
// layers, record, diag. Next: film_add. Flags: INTG_NEE, INTG_MIS, INTG_UNIFORM, INTG_LAYERS,
// INTG_RECORD, INTG_SOBOL, INTG_FILTER.
#include "passes/bundles.h"
#include "passes/tile.h"
#include "transport/path.h"

__kernel void pt_mega(SCENE_PARAMS FILTER_PARAMS FILM_PARAMS
#if INTG_LAYERS
                          LAYER_PARAMS
#endif
                              RECORD_PARAMS DIAG_PARAMS const Launch launch) {
  uint pixel = work_item(launch);
  if (pixel >= launch.tile_width * launch.tile_height) return;
  SCENE_FROM_PARAMS
  TileSample s = tile_sample(launch, camera, filter_table, pixel);
  VertexStore store = vertex_store_at(0, 0, 0u);
  RECORDER(s.rng.path, 0u, 1, 1)
  uint rays;
  real cut;
  real3 radiance = path_radiance(&scene_data, launch, s.rng, s.ray, camera_pdf_w(camera, s.ray.d),
#if INTG_LAYERS
                                 layer_sink(layers, diag, launch, pixel),
#endif
                                 &store, &rays, &cut);
  cut_add(diag, CUT_camera, cut);
  samples[pixel] = (float4)(radiance.x, radiance.y, radiance.z, (float)rays);
}

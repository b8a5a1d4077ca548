// pt_mega: one camera path per pixel, whole.
// Reads: scene, filter. Writes: samples [pixels], diag. Domain: pixels. Atomics: diag only. Next:
// film_add. Flags: INTG_NEE, INTG_MIS, INTG_UNIFORM, INTG_SOBOL, INTG_FILTER.
#include "camera/camera.h"
#include "camera/filter.h"
#include "passes/bundles.h"
#include "transport/path.h"

__kernel void pt_mega(SCENE_PARAMS FILTER_PARAMS FILM_PARAMS DIAG_PARAMS const Launch launch) {
  uint pixel = (uint)get_global_id(0);
  if (pixel >= launch.tile_width * launch.tile_height) return;
  SCENE_FROM_PARAMS
  uint column = launch.tile_x + pixel % launch.tile_width;
  uint row = launch.tile_y + pixel / launch.tile_width;
  Rng rng;
  rng.path = row * launch.width + column;  // of the whole picture: a crop has the same numbers
  rng.iteration = launch.iteration;
  rng.seed = launch.seed;
  FilmPosition at = film_position(filter_table, column, row, rng4(rng, DIM_PIXEL));
  uint rays;
  Ray ray = camera_ray(camera, at.x, at.y);
  real3 radiance = path_radiance(&scene_data, launch, rng, ray, &rays);
  samples[pixel] = (float4)(radiance.x, radiance.y, radiance.z, (float)rays);
}

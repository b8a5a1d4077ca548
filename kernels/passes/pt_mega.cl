// pt_mega: one camera path per pixel, whole.
// Reads: scene. Writes: samples [pixels], diag. Domain: pixels. Atomics: diag only. Next: film_add.
// Flags: INTG_NEE, INTG_MIS, INTG_UNIFORM.
#include "camera/camera.h"
#include "passes/bundles.h"
#include "transport/path.h"

__kernel void pt_mega(SCENE_PARAMS FILM_PARAMS DIAG_PARAMS const Launch launch) {
  uint pixel = (uint)get_global_id(0);
  if (pixel >= launch.width * launch.height) return;
  SCENE_FROM_PARAMS
  Rng rng;
  rng.path = pixel;
  rng.iteration = launch.iteration;
  rng.seed = launch.seed;
  Random4 u = rng4(rng, DIM_PIXEL);
  real x = (real)(pixel % launch.width) + u.x;
  real y = (real)(pixel / launch.width) + u.y;
  uint rays;
  real3 radiance = path_radiance(&scene_data, launch, rng, camera_ray(camera, x, y), &rays);
  samples[pixel] = (float4)(radiance.x, radiance.y, radiance.z, (float)rays);
}

// probe_splat: splats a list of values in work-item order, for the test that sums do not depend on
// it. Reads: values [n] (rgb and, in w, the pixel). Writes: splats [pixels][r g b rays][2], diag.
// Domain: n values. Atomics: splats, diag. Next: film_add.
#include "film/film.h"
#include "passes/bundles.h"

__kernel void probe_splat(SPLAT_PARAMS DIAG_PARAMS __global const F4* values, const uint n,
                          const Launch launch) {
  uint i = (uint)get_global_id(0);
  if (i >= n) return;
  F4 v = values[i];
  int pixel = (int)v.w;
  film_splat(splats, diag, launch, pixel % (int)launch.width, pixel / (int)launch.width, v.x, v.y,
             v.z);
}

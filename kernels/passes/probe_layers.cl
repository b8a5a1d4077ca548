// probe_layers: adds a list of contributions to layers in work-item order, for the test that sums
// do not depend on it. Reads: values [n][2]: rgb and pixel; weight, s, depth. Writes: layers, diag.
// Domain: n values. Atomics: layers, diag. Next: nothing. Flags: INTG_LAYERS.
#include "film/layers.h"
#include "passes/bundles.h"

#if INTG_LAYERS
__kernel void probe_layers(LAYER_PARAMS DIAG_PARAMS __global const F4* values, const uint n,
                           const Launch launch) {
  uint i = (uint)get_global_id(0);
  if (i >= n) return;
  F4 value = values[2 * i], how = values[2 * i + 1];
  int x = (int)value.w % (int)launch.width, y = (int)value.w / (int)launch.width;
  layer_splat(layers, diag, launch, x, y, load3(value), how.x, (uint)how.y, (uint)how.z);
  layer_vertex(layers, diag, launch, x, y);
}
#endif

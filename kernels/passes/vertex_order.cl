// vertex_order: lists the slots of stored vertices sub-path by sub-path, each from its start.
// Reads: light_vertices, light_last, light_first; the same of the eye's side. Writes: light_order,
// eye_order. Domain: light paths of the launch, then pixels of the slice. Atomics: none. Next:
// grid_keys after light_trace alone, else connect or merge.
// Flags: INTG_COMPACT.
#include "passes/bundles.h"
#include "transport/vertex_format.h"

INLINE void order_path(__global const StoredVertex* vertices, __global const uint* first,
                       __global const uint* last, __global uint* order, uint i) {
  uint slot = last[i];
  for (uint place = first[i + 1u]; place > first[i]; --place) {
    order[place - 1u] = slot;
    slot = vertices[slot].before;
  }
}

__kernel void vertex_order(LIGHT_VERTEX_PARAMS EYE_VERTEX_PARAMS const Launch launch) {
  uint i = work_item(launch);
  if (i < launch.path_count) {
    order_path((__global const StoredVertex*)light_vertices, light_first, light_last, light_order,
               i);
  } else if (i - launch.path_count < launch.slice_count) {
    order_path((__global const StoredVertex*)eye_vertices, eye_first, eye_last, eye_order,
               i - launch.path_count);
  }
}

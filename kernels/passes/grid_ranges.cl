// grid_ranges: where each cell's photons begin and end, and what merging needs of them in that
// order. Reads: light_vertices, light_order, grid_pairs (sorted, after an even number of digits).
// Writes: grid_cells, photon_positions, photons. Domain: photons. Atomics: none. Next: merge.
// Flags: INTG_MERGE, INTG_COMPACT.
#include "passes/bundles.h"
#include "transport/stored_vertex.h"

#if INTG_MERGE
__kernel void grid_ranges(LIGHT_VERTEX_PARAMS GRID_PARAMS const Launch launch) {
  uint i = work_item(launch);
  if (i >= launch.photon_count) return;
  __global const uint* pairs = grid_pairs;
  uint key = pairs[2 * (size_t)i];
  if (key == NONE) return;  // all of them stand behind the last cell
  if (i == 0u || pairs[2 * (size_t)i - 2u] != key) grid_cells[2 * key] = i;
  if (i + 1u == launch.photon_count || pairs[2 * (size_t)i + 2u] != key)
    grid_cells[2 * key + 1u] = i + 1u;
  uint slot = light_order[pairs[2 * (size_t)i + 1u]];
  __global const StoredVertex* vertices = (__global const StoredVertex*)light_vertices;
  real3 p = stored_position(&vertices[slot]);
  photon_positions[i] = (F4)(p.x, p.y, p.z, 0.0f);
  photons[i] = photon_of(&vertices[slot]);
}
#endif

// grid_keys: the cell of every light vertex, or NONE for those never merged; empties the table.
// Reads: light_vertices, light_order. Writes: grid_pairs [photons], grid_cells [cells].
// Domain: photons or cells, whichever are more. Atomics: none. Next: grid_count.
// Flags: INTG_MERGE, INTG_NEE, INTG_COMPACT.
#include "passes/bundles.h"
#include "transport/grid.h"
#include "transport/stored_vertex.h"

#if INTG_MERGE
__kernel void grid_keys(LIGHT_VERTEX_PARAMS GRID_PARAMS const Launch launch) {
  uint i = work_item(launch);
  if (i < 1u << launch.grid_bits) grid_cells[2 * i] = grid_cells[2 * i + 1u] = 0u;
  if (i >= launch.photon_count) return;
  __global const StoredVertex* vertices = (__global const StoredVertex*)light_vertices;
  __global const StoredVertex* vertex = &vertices[light_order[i]];
  uint bucket = grid_bucket(launch, grid_cell(launch, stored_position(vertex)));
  grid_pairs[2 * (size_t)i] = stored_merges(vertex) ? bucket : NONE;
  grid_pairs[2 * (size_t)i + 1u] = i;
}
#endif

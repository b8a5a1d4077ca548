// grid_keys: the cell of every light vertex; empties the table.
// Reads: light_vertices, light_order. Writes: grid_pairs [photons], grid_cells [cells].
// Domain: photons or cells, whichever are more. Atomics: none. Next: grid_count.
// Flags: INTG_COMPACT.
#include "passes/bundles.h"
#include "transport/grid.h"
#include "transport/stored_vertex.h"

__kernel void grid_keys(LIGHT_VERTEX_PARAMS GRID_PARAMS const Launch launch) {
  uint i = (uint)get_global_id(0);
  if (i < 1u << launch.grid_bits) grid_cells[2 * i] = grid_cells[2 * i + 1u] = 0u;
  if (i >= launch.photon_count) return;
  __global const StoredVertex* vertices = (__global const StoredVertex*)light_vertices;
  real3 p = stored_position(&vertices[light_order[i]]);
  grid_pairs[2 * (size_t)i] = grid_bucket(launch, grid_cell(launch, p));
  grid_pairs[2 * (size_t)i + 1u] = i;
}

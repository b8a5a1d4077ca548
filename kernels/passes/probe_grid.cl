// probe_grid: what merging finds around a list of points, for the test that these are the photons
// within the radius, each once.
// Reads: grid_pairs (sorted), photon_positions, grid_cells, points [n]. Writes: found [n]: how
// many, and the sums of their places in light_order, of the squares and of the cubes. Domain: n
// points. Atomics: none. Next: nothing.
#include "passes/bundles.h"
#include "transport/grid.h"

__kernel void probe_grid(GRID_PARAMS __global const F4* points, __global U4* found, const uint n,
                         const Launch launch) {
  uint k = (uint)get_global_id(0);
  if (k >= n) return;
  U4 sums = (uint4)(0u);
  GridSearch search = grid_search(launch, grid_cells, load3(points[k]));
  for (;;) {
    uint i = grid_next(launch, photon_positions, grid_cells, &search);
    if (i == NONE) break;
    uint place = grid_pairs[2 * (size_t)i + 1u];
    sums += (uint4)(1u, place, place * place, place * place * place);
  }
  found[k] = sums;
}

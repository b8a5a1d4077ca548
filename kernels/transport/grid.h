// The photon grid: cells of space, hashed into a table. Cells are whole numbers from an origin amid
// the scene, so that neither its place nor its extent in cells matters.
#ifndef PELLUCID_TRANSPORT_GRID_H
#define PELLUCID_TRANSPORT_GRID_H

#include "core/real.h"
#include "shared/layout.h"
#include "shared/limits.h"

/// A cell of space.
typedef struct GridCell {
  int x, y, z;
} GridCell;

INLINE GridCell grid_cell(Launch launch, real3 p) {
  real scale = (real)launch.cells_per_unit;
  GridCell cell;
  cell.x = (int)r_floor((p.x - (real)launch.grid_x) * scale);
  cell.y = (int)r_floor((p.y - (real)launch.grid_y) * scale);
  cell.z = (int)r_floor((p.z - (real)launch.grid_z) * scale);
  return cell;
}

/// Place of a cell in the table; others may have the same. Cells of a block of 2 x 2 x 2 stand side
/// by side, and so do their photons: a search that sees 8 cells then has few places to go to.
INLINE uint grid_bucket(Launch launch, GridCell cell) {
  uint x = (uint)cell.x, y = (uint)cell.y, z = (uint)cell.z;
  uint h = (x >> 1) * 0x9e3779b1u ^ (y >> 1) * 0x85ebca6bu ^ (z >> 1) * 0xc2b2ae35u;
  h ^= h >> 15;
  h *= 0x2c1b3c6du;
  h ^= h >> 12;
  return (h << 3 | (x & 1u) | (y & 1u) << 1 | (z & 1u) << 2) & ((1u << launch.grid_bits) - 1u);
}

/// A search for the photons within the radius of a point.
///
/// The box of cells from that of p - reach to that of p + reach holds them all, to the last bit:
/// |at - p| <= radius in float means |at - p| <= radius (1 + 4 u) along each axis, which is less
/// than reach. So p + reach, before rounding, is at least the number `at`, and so it is after:
/// rounding keeps order. So do all steps of grid_cell, wherever the point lies.
typedef struct GridSearch {
  real3 p;
  GridCell low, high, cell;  // the box, and where in it the search is
  uint next, end;            // photons of that cell's place in the table
} GridSearch;

INLINE void grid_open(Launch launch, GLOBAL const uint* grid_cells, PRIVATE GridSearch* search) {
  uint bucket = grid_bucket(launch, search->cell);
  search->next = grid_cells[2 * bucket];
  search->end = grid_cells[2 * bucket + 1u];
}

INLINE GridSearch grid_search(Launch launch, GLOBAL const uint* grid_cells, real3 p) {
  real reach = (real)launch.radius * (real)MERGE_REACH;
  GridSearch search;
  search.p = p;
  search.low = search.cell = grid_cell(launch, p - reach);
  search.high = grid_cell(launch, p + reach);
  grid_open(launch, grid_cells, &search);
  return search;
}

/// Goes to the next cell of the box; 0 after the last.
INLINE int grid_advance(PRIVATE GridSearch* s) {
  if (s->cell.x++ < s->high.x) return 1;
  s->cell.x = s->low.x;
  if (s->cell.y++ < s->high.y) return 1;
  s->cell.y = s->low.y;
  return s->cell.z++ < s->high.z;
}

/// The next photon found, or NONE after the last.
INLINE uint grid_next(Launch launch, GLOBAL const F4* positions, GLOBAL const uint* grid_cells,
                      PRIVATE GridSearch* search) {
  real radius2 = (real)launch.radius * (real)launch.radius;
  for (;;) {
    while (search->next < search->end) {
      uint i = search->next++;
      real3 at = load3(positions[i]), d = at - search->p;
      if (dot3(d, d) > radius2) continue;
      // Other cells may have the same place in the table: a photon is met in its own alone.
      GridCell own = grid_cell(launch, at);
      if (own.x == search->cell.x && own.y == search->cell.y && own.z == search->cell.z) return i;
    }
    if (!grid_advance(search)) return NONE;
    grid_open(launch, grid_cells, search);
  }
}

#endif

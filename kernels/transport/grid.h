// The photon grid: cells of space, hashed into a table. Cells are whole numbers from the scene's
// own origin, so that neither its place nor its extent in cells matters.
#ifndef PELLUCID_TRANSPORT_GRID_H
#define PELLUCID_TRANSPORT_GRID_H

#include "core/real.h"
#include "geom/scene_data.h"
#include "shared/limits.h"

/// A cell of space.
typedef struct GridCell {
  int x, y, z;
} GridCell;

INLINE int grid_coordinate(real x, real origin, real inv_size) {
  return (int)r_floor((x - origin) * inv_size);
}
INLINE GridCell grid_cell(PRIVATE const SceneData* scene, Launch launch, real3 p) {
  F4 c = scene->info.center_radius;
  real inv = REAL(1.0) / (real)launch.cell_size;
  GridCell cell;
  cell.x = grid_coordinate(p.x, (real)c.x, inv);
  cell.y = grid_coordinate(p.y, (real)c.y, inv);
  cell.z = grid_coordinate(p.z, (real)c.z, inv);
  return cell;
}

/// Place of a cell in the table; others may have the same.
INLINE uint grid_bucket(Launch launch, GridCell cell) {
  uint h = (uint)cell.x * 0x9e3779b1u ^ (uint)cell.y * 0x85ebca6bu ^ (uint)cell.z * 0xc2b2ae35u;
  h ^= h >> 15;
  h *= 0x2c1b3c6du;
  h ^= h >> 12;
  return h & ((1u << launch.grid_bits) - 1u);
}

/// Box of cells in which everything within the radius of p lies, rounding included.
typedef struct GridRange {
  GridCell low, high;
} GridRange;

INLINE GridRange grid_range(PRIVATE const SceneData* scene, Launch launch, real3 p) {
  real extent = max3(abs3(p));
  real reach = (real)launch.radius * (real)MERGE_REACH_SCALE +
               extent * (real)(MERGE_REACH_ULPS * UNIT_ROUNDOFF);
  GridRange range;
  range.low = grid_cell(scene, launch, REAL3(p.x - reach, p.y - reach, p.z - reach));
  range.high = grid_cell(scene, launch, REAL3(p.x + reach, p.y + reach, p.z + reach));
  return range;
}

INLINE int grid_same(GridCell a, GridCell b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

#endif

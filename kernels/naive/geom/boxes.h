// For the benchmark alone (README.md): boxes as fast code tests them, without room for rounding.
#ifndef PELLUCID_GEOM_BOXES_H
#define PELLUCID_GEOM_BOXES_H

#include "core/simd.h"
#include "geom/ray.h"
#include "shared/layout.h"

/// Per-ray constants of the slab test: t = bound * inv + add.
typedef struct RaySlabs {
  real3 inv, add;
  uint sx, sy, sz;  // lane offset of the near plane, as geom/boxes.h has it
} RaySlabs;

INLINE void slab_axis(real o, real d, PRIVATE real* inv, PRIVATE real* add) {
  real safe = sign_of(r_max(r_abs(d), (real)DIRECTION_MIN), d);
  *inv = REAL(1.0) / safe;
  *add = -o * *inv;
}

INLINE RaySlabs ray_slabs(Ray ray, F4 reach) {
  RaySlabs s;
  real inv, add;
  slab_axis(ray.o.x, ray.d.x, &inv, &add);
  s.inv.x = inv, s.add.x = add;
  slab_axis(ray.o.y, ray.d.y, &inv, &add);
  s.inv.y = inv, s.add.y = add;
  slab_axis(ray.o.z, ray.d.z, &inv, &add);
  s.inv.z = inv, s.add.z = add;
  s.sx = ray.d.x < REAL(0.0) ? SIMD_WIDTH : 0u;
  s.sy = ray.d.y < REAL(0.0) ? SIMD_WIDTH : 0u;
  s.sz = ray.d.z < REAL(0.0) ? SIMD_WIDTH : 0u;
  return s;
}

/// Bit mask of the children of `node` whose box the ray meets in [0, t_max]; their entry distances.
INLINE uint node_hits(GLOBAL const float* node, RaySlabs s, real t_max, PRIVATE vreal* entry) {
  vreal ix = v_splat(s.inv.x), iy = v_splat(s.inv.y), iz = v_splat(s.inv.z);
  vreal x = v_splat(s.add.x), y = v_splat(s.add.y), z = v_splat(s.add.z);
  vreal nx = v_fma(v_load(node + s.sx), ix, x);
  vreal ny = v_fma(v_load(node + 2 * SIMD_WIDTH + s.sy), iy, y);
  vreal nz = v_fma(v_load(node + 4 * SIMD_WIDTH + s.sz), iz, z);
  vreal fx = v_fma(v_load(node + SIMD_WIDTH - s.sx), ix, x);
  vreal fy = v_fma(v_load(node + 3 * SIMD_WIDTH - s.sy), iy, y);
  vreal fz = v_fma(v_load(node + 5 * SIMD_WIDTH - s.sz), iz, z);
  vreal tn = v_max(v_max(nx, ny), v_max(nz, v_splat(REAL(0.0))));
  vreal tf = v_min(v_min(fx, fy), v_min(fz, v_splat(t_max)));
  *entry = tn;
  return v_mask_le(tn, tf);
}

#endif

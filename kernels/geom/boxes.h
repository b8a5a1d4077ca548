// Rays against the boxes of a node: padded, so that a hit is never lost to rounding.
#ifndef PELLUCID_GEOM_BOXES_H
#define PELLUCID_GEOM_BOXES_H

#include "core/simd.h"
#include "geom/ray.h"
#include "shared/layout.h"

/// Per-ray constants of the slab test: t_near = bound * inv + near_add, and so for the far side;
/// the additions carry the padding, so padded boxes cost nothing per node.
typedef struct RaySlabs {
  real3 inv, near_add, far_add;
  uint sx, sy,
      sz;  // lane offset of the near plane: 0, or SIMD_WIDTH where the ray goes down the axis
} RaySlabs;

INLINE void slab_axis(real o, real d, real reach, PRIVATE real* inv, PRIVATE real* near_add,
                      PRIVATE real* far_add) {
  real safe = sign_of(r_max(r_abs(d), (real)DIRECTION_MIN), d);
  real i = REAL(1.0) / safe;
  real pad = (real)(BOX_PAD_ULPS * UNIT_ROUNDOFF) * (r_abs(o) + reach) * r_abs(i);
  *inv = i;
  *near_add = -o * i - pad;
  *far_add = -o * i + pad;
}

INLINE RaySlabs ray_slabs(Ray ray, F4 reach) {
  RaySlabs s;
  real inv, near_add, far_add;
  slab_axis(ray.o.x, ray.d.x, reach.x, &inv, &near_add, &far_add);
  s.inv.x = inv, s.near_add.x = near_add, s.far_add.x = far_add;
  slab_axis(ray.o.y, ray.d.y, reach.y, &inv, &near_add, &far_add);
  s.inv.y = inv, s.near_add.y = near_add, s.far_add.y = far_add;
  slab_axis(ray.o.z, ray.d.z, reach.z, &inv, &near_add, &far_add);
  s.inv.z = inv, s.near_add.z = near_add, s.far_add.z = far_add;
  s.sx = ray.d.x < REAL(0.0) ? SIMD_WIDTH : 0u;
  s.sy = ray.d.y < REAL(0.0) ? SIMD_WIDTH : 0u;
  s.sz = ray.d.z < REAL(0.0) ? SIMD_WIDTH : 0u;
  return s;
}

/// Bit mask of the children of `node` whose box the ray meets in [0, t_max]; their entry distances.
INLINE uint node_hits(GLOBAL const float* node, RaySlabs s, real t_max, PRIVATE vreal* entry) {
  vreal nx = v_fma(v_load(node + s.sx), v_splat(s.inv.x), v_splat(s.near_add.x));
  vreal ny = v_fma(v_load(node + 2 * SIMD_WIDTH + s.sy), v_splat(s.inv.y), v_splat(s.near_add.y));
  vreal nz = v_fma(v_load(node + 4 * SIMD_WIDTH + s.sz), v_splat(s.inv.z), v_splat(s.near_add.z));
  vreal fx = v_fma(v_load(node + SIMD_WIDTH - s.sx), v_splat(s.inv.x), v_splat(s.far_add.x));
  vreal fy = v_fma(v_load(node + 3 * SIMD_WIDTH - s.sy), v_splat(s.inv.y), v_splat(s.far_add.y));
  vreal fz = v_fma(v_load(node + 5 * SIMD_WIDTH - s.sz), v_splat(s.inv.z), v_splat(s.far_add.z));
  vreal tn = v_max(v_max(nx, ny), v_max(nz, v_splat(REAL(0.0))));
  vreal tf = v_min(v_min(fx, fy), v_min(fz, v_splat(t_max)));
  *entry = tn;
  return v_mask_le(tn, tf);
}

#endif

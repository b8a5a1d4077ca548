// For the benchmark alone (README.md): ray against a leaf block of triangles as fast code does it
// [Moeller97]. Blocks hold v0, v1 - v0, v2 - v0 (host/bench/naive_rays.h); everything that can be
// one fma is one.
#ifndef PELLUCID_GEOM_TRIANGLE_H
#define PELLUCID_GEOM_TRIANGLE_H

#include "core/simd.h"
#include "geom/ray.h"

/// What the test needs of a ray.
typedef struct RayShear {
  real3 o, d;
} RayShear;

INLINE RayShear ray_shear(Ray ray) {
  RayShear s;
  s.o = ray.o;
  s.d = ray.d;
  return s;
}

/// a b - c d.
INLINE vreal v_cross(vreal a, vreal b, vreal c, vreal d) {
  return v_fma(a, b, -(c * d));
}
INLINE vreal v_dot(vreal ax, vreal ay, vreal az, vreal bx, vreal by, vreal bz) {
  return v_fma(ax, bx, v_fma(ay, by, az * bz));
}

/// Tests the block at `v` ([3 vertices][3 axes][SIMD_WIDTH] floats) and improves `hit`; ties go to
/// the lowest primitive id.
INLINE void triangle_block(GLOBAL const float* v, GLOBAL const uint* prims, RayShear s, int needles,
                           PRIVATE Hit* hit) {
  vreal dx = v_splat(s.d.x), dy = v_splat(s.d.y), dz = v_splat(s.d.z);
  vreal e1x = v_load(v + 3 * SIMD_WIDTH), e1y = v_load(v + 4 * SIMD_WIDTH);
  vreal e1z = v_load(v + 5 * SIMD_WIDTH);
  vreal e2x = v_load(v + 6 * SIMD_WIDTH), e2y = v_load(v + 7 * SIMD_WIDTH);
  vreal e2z = v_load(v + 8 * SIMD_WIDTH);
  vreal px = v_cross(dy, e2z, dz, e2y), py = v_cross(dz, e2x, dx, e2z);
  vreal pz = v_cross(dx, e2y, dy, e2x);
  vreal sx = v_splat(s.o.x) - v_load(v), sy = v_splat(s.o.y) - v_load(v + SIMD_WIDTH);
  vreal sz = v_splat(s.o.z) - v_load(v + 2 * SIMD_WIDTH);
  vreal det = v_dot(e1x, e1y, e1z, px, py, pz);
  vreal u1 = v_dot(sx, sy, sz, px, py, pz);
  vreal qx = v_cross(sy, e1z, sz, e1y), qy = v_cross(sz, e1x, sx, e1z);
  vreal qz = v_cross(sx, e1y, sy, e1x);
  vreal u2 = v_dot(dx, dy, dz, qx, qy, qz);
  vreal u0 = det - u1 - u2;
  vreal zero = v_splat(REAL(0.0));
  uint inside =
      v_mask_le(zero, v_min(u1, v_min(u2, u0))) | v_mask_le(v_max(u1, v_max(u2, u0)), zero);
  if (inside == 0u) return;
  vreal inv = v_splat(REAL(1.0)) / det;
  vreal b1 = u1 * inv, b2 = u2 * inv;
  vreal t = v_dot(e2x, e2y, e2z, qx, qy, qz) * inv;
  // A triangle without area has det = 0: t is no number and fails one of these.
  inside &= v_mask_lt(zero, t) & v_mask_le(t, v_splat(hit->t));
  if (inside == 0u) return;
  SIMD_ALIGNED real lane_t[SIMD_WIDTH];
  SIMD_ALIGNED real lane_b1[SIMD_WIDTH];
  SIMD_ALIGNED real lane_b2[SIMD_WIDTH];
  v_store(t, lane_t);
  v_store(b1, lane_b1);
  v_store(b2, lane_b2);
  do {
    uint i = lowest_bit(inside);
    inside &= inside - 1u;
    uint prim = prims[i];
    if (lane_t[i] < hit->t || (lane_t[i] == hit->t && prim < hit->prim)) {
      hit->t = lane_t[i];
      hit->b1 = lane_b1[i];
      hit->b2 = lane_b2[i];
      hit->prim = prim;
    }
  } while (inside);
}

#endif

// Watertight ray-triangle test over a whole leaf block [Woop13]: every vertex is sheared into ray
// space once and alike in all triangles that share it, and a zero edge function is settled exactly.
#ifndef PELLUCID_GEOM_TRIANGLE_H
#define PELLUCID_GEOM_TRIANGLE_H

#include "core/simd.h"
#include "geom/ray.h"

EXACT_BEGIN

/// What the test needs of a ray, computed once.
typedef struct RayShear {
  uint kx, ky, kz;  // kz: axis of the largest |d|
  real ox, oy, oz;  // origin, permuted
  real sx, sy, sz;  // shear: d[kx]/d[kz], d[ky]/d[kz], 1/d[kz]
} RayShear;

INLINE RayShear ray_shear(Ray ray) {
  real ax = r_abs(ray.d.x), ay = r_abs(ray.d.y), az = r_abs(ray.d.z);
  RayShear s;
  s.kz = ax > ay ? (ax > az ? 0u : 2u) : (ay > az ? 1u : 2u);
  s.kx = s.kz == 2u ? 0u : s.kz + 1u;
  s.ky = s.kx == 2u ? 0u : s.kx + 1u;
  real dz = s.kz == 0u ? ray.d.x : (s.kz == 1u ? ray.d.y : ray.d.z);
  real dx = s.kx == 0u ? ray.d.x : (s.kx == 1u ? ray.d.y : ray.d.z);
  real dy = s.ky == 0u ? ray.d.x : (s.ky == 1u ? ray.d.y : ray.d.z);
  s.oz = s.kz == 0u ? ray.o.x : (s.kz == 1u ? ray.o.y : ray.o.z);
  s.ox = s.kx == 0u ? ray.o.x : (s.kx == 1u ? ray.o.y : ray.o.z);
  s.oy = s.ky == 0u ? ray.o.x : (s.ky == 1u ? ray.o.y : ray.o.z);
  s.sz = REAL(1.0) / dz;
  s.sx = dx * s.sz;
  s.sy = dy * s.sz;
  return s;
}

/// a b - c d, rounded; where the rounded products are equal, and for needles wherever, with the
/// difference of their rounding errors, which in the first case is the exact value (two fma, no
/// fp64 needed).
INLINE vreal edge_exact(vreal a, vreal b, vreal c, vreal d, int needles) {
  vreal ab = a * b, cd = c * d;
  vreal rounded = ab - cd, rest = v_fma(a, b, -ab) - v_fma(c, d, -cd);
  return needles ? rounded + rest : v_if_zero(rounded, rest);
}

/// Tests the block at `v` ([3 vertices][3 axes][SIMD_WIDTH] floats) and improves `hit` (t, weights,
/// prim). Equal distances go to the lowest primitive id, so the order of visits does not matter.
///
/// Edge functions are off by roundoffs of a triangle's length squared, weights by those over its
/// area, and so distances by its length times that over its width: of `needles` far more than rays
/// start beside them. They get edge functions without that error; what is left is that of vertices.
INLINE void triangle_block(GLOBAL const float* v, GLOBAL const uint* prims, RayShear s, int needles,
                           PRIVATE Hit* hit) {
  GLOBAL const float* vx = v + s.kx * SIMD_WIDTH;
  GLOBAL const float* vy = v + s.ky * SIMD_WIDTH;
  GLOBAL const float* vz = v + s.kz * SIMD_WIDTH;
  vreal ox = v_splat(s.ox), oy = v_splat(s.oy), oz = v_splat(s.oz);
  vreal az = v_load(vz) - oz;
  vreal bz = v_load(vz + 3 * SIMD_WIDTH) - oz;
  vreal cz = v_load(vz + 6 * SIMD_WIDTH) - oz;
  vreal nsx = v_splat(-s.sx), nsy = v_splat(-s.sy);
  vreal ax = v_fma(nsx, az, v_load(vx) - ox), ay = v_fma(nsy, az, v_load(vy) - oy);
  vreal bx = v_fma(nsx, bz, v_load(vx + 3 * SIMD_WIDTH) - ox);
  vreal by = v_fma(nsy, bz, v_load(vy + 3 * SIMD_WIDTH) - oy);
  vreal cx = v_fma(nsx, cz, v_load(vx + 6 * SIMD_WIDTH) - ox);
  vreal cy = v_fma(nsy, cz, v_load(vy + 6 * SIMD_WIDTH) - oy);
  vreal e0 = cx * by - cy * bx;
  vreal e1 = ax * cy - ay * cx;
  vreal e2 = bx * ay - by * ax;
  vreal zero = v_splat(REAL(0.0));
  // Rounded differences may be 0 where the true value is not, but never have the wrong sign: this
  // mask is a superset of the hits.
  vreal least = v_min(e0, v_min(e1, e2)), most = v_max(e0, v_max(e1, e2));
  uint inside = v_mask_le(zero, least) | v_mask_le(most, zero);
  if (inside == 0u) return;
  // Or a zero among them.
  if (needles || inside != (v_mask_lt(zero, least) | v_mask_lt(most, zero))) {
    e0 = edge_exact(cx, by, cy, bx, needles);
    e1 = edge_exact(ax, cy, ay, cx, needles);
    e2 = edge_exact(bx, ay, by, ax, needles);
    inside &= v_mask_le(zero, v_min(e0, v_min(e1, e2))) | v_mask_le(v_max(e0, v_max(e1, e2)), zero);
  }
  vreal det = e0 + e1 + e2;
  vreal inv = v_splat(REAL(1.0)) / det;
  vreal b1 = e1 * inv, b2 = e2 * inv;
  vreal t = v_fma(e0, az, v_fma(e1, bz, e2 * cz)) * v_splat(s.sz) * inv;
  // A degenerate triangle has det = 0, so t is NaN or infinite and fails one of these.
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

EXACT_END

#endif

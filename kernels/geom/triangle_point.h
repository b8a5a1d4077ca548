// Points of triangles from barycentrics, with a bound on their error. The host compiles this, too:
// what starts rays in benchmarks and measurements is this very code (host/pack/triangle_start.cpp).
#ifndef PELLUCID_GEOM_TRIANGLE_POINT_H
#define PELLUCID_GEOM_TRIANGLE_POINT_H

#include "core/real.h"
#include "shared/limits.h"

/// Normal of a triangle with edges e1, e2, as long as twice its area over *scale squared. Dividing
/// by the largest component first keeps squares in range for edges of any length.
INLINE real3 scaled_normal(real3 e1, real3 e2, PRIVATE real* scale) {
  *scale = r_max(max3(abs3(e1)), max3(abs3(e2)));
  real inv = REAL(1.0) / *scale;
  return cross3(e1 * inv, e2 * inv);
}

typedef struct TrianglePoint {
  real3 p;      // on the triangle up to `offset`
  real3 ng;     // unit geometric normal, front side
  real offset;  // distance along ng that surely clears the rounding error of p
} TrianglePoint;

/// The point b1 v1 + b2 v2 + (1 - b1 - b2) v0. Rebuilt so it is far more accurate than o + t d; its
/// error is bounded by POINT_ERROR_ULPS roundoffs of sum |b_i v_i| per axis, projected on the
/// normal [PBRT4 6.8].
INLINE TrianglePoint point_of_triangle(real3 v0, real3 v1, real3 v2, real b1, real b2) {
  TrianglePoint at;
  real b0 = REAL(1.0) - b1 - b2;
  at.p = v0 * b0 + v1 * b1 + v2 * b2;
  real scale;
  at.ng = normalize3(scaled_normal(v1 - v0, v2 - v0, &scale));
  real3 bound = abs3(v0 * b0) + abs3(v1 * b1) + abs3(v2 * b2);
  // The intersector's own error grows with the triangle, also where the bound above vanishes
  // because the plane passes through coordinate 0.
  real extent = max3(abs3(v1 - v0)) + max3(abs3(v2 - v0));
  at.offset = (real)(POINT_ERROR_ULPS * UNIT_ROUNDOFF) * dot3(abs3(at.ng), bound) +
              (real)(EXTENT_ERROR_ULPS * UNIT_ROUNDOFF) * extent;
  return at;
}

#endif

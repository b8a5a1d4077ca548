// Points of triangles from barycentrics, with a bound on their error. The host includes this, too:
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

/// Weights of a point of a triangle with edges e1, e2, moved so far inside that it is at least
/// `margin` off each side (of needles: an eighth of their height): nearer to the edge of two walls,
/// rounding might put it on the other side of the other wall, and rays from it would leave a closed
/// room. `area2`: twice the area over the square of `scale`, the largest component of e1 and e2.
INLINE real3 weights_inside(real3 b, real3 e1, real3 e2, real scale, real area2, real margin) {
  real inv = REAL(1.0) / scale, unit = margin * inv / area2;
  if (r_min(b.x, r_min(b.y, b.z)) >= (real)SIDE_MAX * unit) return b;  // nearly always
  b.y = r_max(b.y, r_min(length3(e2 * inv) * unit, (real)INSET_MAX));
  b.z = r_max(b.z, r_min(length3(e1 * inv) * unit, (real)INSET_MAX));
  real most = REAL(1.0) - r_min(length3((e2 - e1) * inv) * unit, (real)INSET_MAX);
  real shrink = r_min(most / (b.y + b.z), REAL(1.0));
  b.y *= shrink;
  b.z *= shrink;
  b.x = REAL(1.0) - b.y - b.z;
  return b;
}

typedef struct TrianglePoint {
  real3 p;      // on the triangle up to `offset`
  real3 ng;     // unit geometric normal, front side
  real offset;  // distance along ng that surely clears the rounding error of p
} TrianglePoint;

/// The point b1 v1 + b2 v2 + (1 - b1 - b2) v0, off the sides (weights_inside). Rebuilt so it is far
/// more accurate than o + t d; its error is bounded by POINT_ERROR_ULPS roundoffs of sum |b_i v_i|
/// per axis, projected on the normal [PBRT4 6.8].
INLINE TrianglePoint point_of_triangle(real3 v0, real3 v1, real3 v2, real b1, real b2) {
  TrianglePoint at;
  real scale;
  real3 e1 = v1 - v0, e2 = v2 - v0;
  at.ng = scaled_normal(e1, e2, &scale);
  real area2 = length3(at.ng);
  at.ng = at.ng * (REAL(1.0) / area2);
  real3 b = REAL3(REAL(1.0) - b1 - b2, b1, b2);
  real3 bound = abs3(v0 * b.x) + abs3(v1 * b.y) + abs3(v2 * b.z);
  // The intersector's own error grows with the triangle, also where the bound above vanishes
  // because the plane passes through coordinate 0.
  real extent_error = (real)(EXTENT_ERROR_ULPS * UNIT_ROUNDOFF) * (max3(abs3(e1)) + max3(abs3(e2)));
  real point_error = (real)(POINT_ERROR_ULPS * UNIT_ROUNDOFF);
  at.offset = point_error * dot3(abs3(at.ng), bound) + extent_error;
  b = weights_inside(b, e1, e2, scale, area2,
                     (real)INSET_ERRORS * (point_error * max3(bound) + extent_error));
  at.p = v0 * b.x + v1 * b.y + v2 * b.z;
  return at;
}

#endif

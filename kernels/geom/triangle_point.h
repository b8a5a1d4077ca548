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

/// The way from a point of a triangle to where it is `margin` off the sides (of needles: an eighth
/// of their height), straight in from each. Nearer to the edge that two walls share, rounding might
/// put it on the other side of the other wall, and rays from it would leave a closed room. At
/// corners, where moving off one side moves towards the next, the rounds below end near that.
/// `b`: weights of the corners; `area2`: twice the area over the square of `scale`, the largest
/// component of the edges e1 and e2.
INLINE real3 way_inside(real3 b, real3 ng, real3 e1, real3 e2, real scale, real area2,
                        real margin) {
  real3 way = REAL3(0.0, 0.0, 0.0);
  real unit = area2 * scale;  // a side's height times its length over scale
  if (r_min(b.x, r_min(b.y, b.z)) * unit >= (real)SIDE_MAX * margin) return way;  // nearly always
  real inv = REAL(1.0) / scale;
  real height[3] = {b.x, b.y, b.z};
  real least[3];
  real3 inwards[3];  // sides opposite each corner, then at right angles to them
  inwards[0] = (e2 - e1) * inv;
  inwards[1] = e2 * -inv;
  inwards[2] = e1 * inv;
  for (int i = 0; i < 3; ++i) {
    real side = length3(inwards[i]), whole = unit / side;
    inwards[i] = cross3(ng, inwards[i]) * (REAL(1.0) / side);
    height[i] *= whole;
    least[i] = r_min(margin, (real)INSET_MAX * whole);
  }
  for (int k = 0; k < 3 * INSET_ROUNDS; ++k) {
    int i = k % 3;
    real missing = least[i] - height[i] - dot3(inwards[i], way);
    if (missing > REAL(0.0)) way += inwards[i] * missing;
  }
  return way;
}

typedef struct TrianglePoint {
  real3 p;      // on the triangle up to `offset`
  real3 ng;     // unit geometric normal, front side
  real offset;  // distance along ng that surely clears the rounding error of p
} TrianglePoint;

/// The point b1 v1 + b2 v2 + (1 - b1 - b2) v0, off the sides (way_inside). Rebuilt so it is far
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
  at.p = v0 * b.x + v1 * b.y + v2 * b.z +
         way_inside(b, at.ng, e1, e2, scale, area2,
                    (real)INSET_ERRORS * (point_error * max3(bound) + extent_error));
  return at;
}

#endif

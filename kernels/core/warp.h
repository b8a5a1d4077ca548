// Maps from the unit square to directions and points, each with its density.
#ifndef PELLUCID_CORE_WARP_H
#define PELLUCID_CORE_WARP_H

#include "core/math.h"

/// Direction with density cos/pi over the hemisphere z > 0 [1/sr].
INLINE real3 warp_cosine_hemisphere(real u, real v) {
  SinCos phi = sincos_2pi(v);
  real r = r_sqrt(u);
  return REAL3(r * phi.c, r * phi.s, r_sqrt(REAL(1.0) - u));
}
/// Direction with density 1/(4 pi) over the sphere.
INLINE real3 warp_sphere(real u, real v) {
  SinCos phi = sincos_2pi(v);
  real z = REAL(1.0) - REAL(2.0) * u;
  // 1 - z^2 written without cancellation
  real r = REAL(2.0) * r_sqrt(u * (REAL(1.0) - u));
  return REAL3(r * phi.c, r * phi.s, z);
}
/// Direction with density 1/(2 pi) over the hemisphere z >= 0.
INLINE real3 warp_hemisphere(real u, real v) {
  SinCos phi = sincos_2pi(v);
  real r = r_sqrt(u * (REAL(2.0) - u));
  return REAL3(r * phi.c, r * phi.s, REAL(1.0) - u);
}
/// Point of the unit disk with density 1/pi; z = 0.
INLINE real3 warp_disk(real u, real v) {
  SinCos phi = sincos_2pi(v);
  real r = r_sqrt(u);
  return REAL3(r * phi.c, r * phi.s, REAL(0.0));
}
/// Barycentric weights (b1, b2) of a uniform point of a triangle; b0 = 1 - b1 - b2.
INLINE real3 warp_triangle(real u, real v) {
  real r = r_sqrt(u);
  real b1 = r * (REAL(1.0) - v);
  real b2 = r * v;
  return REAL3(REAL(1.0) - r, b1, b2);
}

#endif

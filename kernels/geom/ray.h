// Rays, hits, and where a spawned ray may start.
#ifndef PELLUCID_GEOM_RAY_H
#define PELLUCID_GEOM_RAY_H

#include "core/real.h"
#include "shared/layout.h"
#include "shared/limits.h"

typedef struct Ray {
  real3 o;     // world units
  real3 d;     // unit
  real t_max;  // hits lie in (0, t_max]
  uint aim;    // 1 + id of the sphere that a shadow ray ends on and that cannot block it; 0: none
} Ray;

INLINE Ray make_ray(real3 o, real3 d, real t_max) {
  Ray ray;
  ray.o = o;
  ray.d = d;
  ray.t_max = t_max;
  ray.aim = 0;
  return ray;
}

typedef struct Hit {
  real t;       // distance along the ray
  real b1, b2;  // triangle: weights of v1 and v2; quadric: 0
  uint prim;    // primitive id, or NONE
} Hit;

/// Start of a ray that leaves the surface point p along w: p moved by `offset` (an error bound
/// along the geometric normal, see Surface) to the side of w. No absolute epsilon.
INLINE real3 spawn_origin(real3 p, real3 ng, real offset, real3 w) {
  return p + ng * (dot3(ng, w) < REAL(0.0) ? -offset : offset);
}

#endif

// For the benchmark alone (README.md): rays that start a fixed distance off their surface.
#ifndef PELLUCID_GEOM_RAY_H
#define PELLUCID_GEOM_RAY_H

#include "core/real.h"
#include "shared/layout.h"
#include "shared/limits.h"

typedef struct Ray {
  real3 o;     // world units
  real3 d;     // unit
  real t_max;  // hits lie in (0, t_max]
  uint aim;    // as geom/ray.h has it
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

/// The usual epsilon, in world units: the same as hits in (epsilon, t_max] from p, at both ends.
INLINE real3 spawn_origin(real3 p, real3 ng, real offset, real3 w) {
  return p + w * (real)NAIVE_EPSILON;
}

#endif

// Analytic spheres and disks.
#ifndef PELLUCID_GEOM_QUADRIC_H
#define PELLUCID_GEOM_QUADRIC_H

#include "geom/ray.h"

EXACT_BEGIN

/// Distance to the first hit in (0, t_max], or a negative number. The discriminant comes from the
/// closest approach, not from b^2 - 4ac, which loses (distance/radius)^2 digits [Haines19].
INLINE real sphere_hit(F4 center_radius, Ray ray) {
  real3 oc = ray.o - load3(center_radius);
  real r = (real)center_radius.w;
  real b = dot3(oc, ray.d);
  real3 l = oc - ray.d * b;
  real l2 = dot3(l, l);
  real disc = r * r - l2;
  if (!(disc >= REAL(0.0))) return REAL(-1.0);
  real h = r_sqrt(disc);
  real q = b < REAL(0.0) ? h - b : -(h + b);  // root of larger magnitude, no cancellation
  real dist = length3(oc);
  real c = (dist - r) * (dist + r);
  real t0 = q, t1 = q != REAL(0.0) ? c / q : REAL(0.0);
  real near_t = r_min(t0, t1), far_t = r_max(t0, t1);
  real t = near_t > REAL(0.0) ? near_t : far_t;
  return t <= ray.t_max ? t : REAL(-1.0);
}

INLINE real disk_hit(F4 center_radius, F4 normal, Ray ray) {
  real3 n = load3(normal);
  real3 c = load3(center_radius);
  real cos_d = dot3(ray.d, n);
  if (cos_d == REAL(0.0)) return REAL(-1.0);
  real t = dot3(c - ray.o, n) / cos_d;
  if (!(t > REAL(0.0)) || !(t <= ray.t_max)) return REAL(-1.0);
  real3 p = ray.o + ray.d * t - c;
  real r = (real)center_radius.w;
  return dot3(p, p) <= r * r ? t : REAL(-1.0);
}

INLINE real quadric_hit(Quadric q, Ray ray) {
#if FEAT_SPHERES && FEAT_DISKS
  return q.kind == QUADRIC_SPHERE ? sphere_hit(q.center_radius, ray)
                                  : disk_hit(q.center_radius, q.normal, ray);
#elif FEAT_DISKS
  return disk_hit(q.center_radius, q.normal, ray);
#else
  return sphere_hit(q.center_radius, ray);
#endif
}

EXACT_END

#endif

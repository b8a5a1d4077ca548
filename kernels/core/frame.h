// Orthonormal frames around a normal.
#ifndef PELLUCID_CORE_FRAME_H
#define PELLUCID_CORE_FRAME_H

#include "core/real.h"

typedef struct Frame {
  real3 s, t, n;  // right-handed, unit
} Frame;

/// Frame around a unit normal without a singular direction [Duff17].
INLINE Frame frame_from_normal(real3 n) {
  real sign = n.z < REAL(0.0) ? REAL(-1.0) : REAL(1.0);
  real a = REAL(-1.0) / (sign + n.z);
  real b = n.x * n.y * a;
  Frame f;
  f.s = REAL3(REAL(1.0) + sign * n.x * n.x * a, sign * b, -sign * n.x);
  f.t = REAL3(b, sign + n.y * n.y * a, -n.y);
  f.n = n;
  return f;
}
INLINE real3 to_local(Frame f, real3 v) {
  return REAL3(dot3(v, f.s), dot3(v, f.t), dot3(v, f.n));
}
INLINE real3 to_world(Frame f, real3 v) {
  return f.s * v.x + f.t * v.y + f.n * v.z;
}

#endif

// probe_math: what the device makes of the arithmetic and functions that kernels use, for the host
// to compare with double. Reads: arguments [n]. Writes: out [MATH_PROBES][n]. Domain: n. Next:
// nothing.
#include "core/math.h"
#include "shared/probe.h"

INLINE float probe_divide(F4 a) {
  return a.x / a.y;
}
INLINE float probe_sqrt(F4 a) {
  return r_sqrt(r_abs(a.x));
}
INLINE float probe_fma(F4 a) {
  float product = a.x * a.y;
  return r_fma(a.x, a.y, -product);
}
INLINE float probe_floor(F4 a) {
  return r_floor(a.x);
}
INLINE float probe_sin(F4 a) {
  return sincos_2pi(a.z).s;
}
INLINE float probe_cos(F4 a) {
  return sincos_2pi(a.z).c;
}
INLINE float probe_atan2(F4 a) {
  return atan2_turns(a.z - 0.5f, a.x - a.y);
}
INLINE float probe_pow(F4 a) {
  return pow_unit(a.z, a.w);
}
INLINE float probe_acos(F4 a) {
  return acos_unit(a.z);
}

#define PROBE_ONE(name, unit, bound, loose, meaning) out[k++ * n + i] = probe_##name(a);

__kernel void probe_math(__global const F4* arguments, __global float* out, const uint n) {
  uint i = (uint)get_global_id(0), k = 0;
  if (i >= n) return;
  F4 a = arguments[i];
  MATH_PROBES(PROBE_ONE)
}

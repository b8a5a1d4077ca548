// Scalars and 3-vectors of the kernel core in the subset that compiles as OpenCL C and as C++ (the
// twin, with real = float or double). Operators + - * / work per component; no swizzles.
#ifndef PELLUCID_CORE_REAL_H
#define PELLUCID_CORE_REAL_H

#include "shared/platform.h"

#if PELLUCID_DEVICE
// PoCL contracts a*b+c by default, which --float mad allows; --float fast lets compilers reorder,
// too. Where rays meet shapes, and where rounding is computed to make up for it, neither happens in
// any mode: EXACT_BEGIN and EXACT_END stand around that. OpenCL has no word against reordering;
// clang, which nearly all drivers are made of, has.
#if FLOAT_REORDER && defined(__clang__)
#define EXACT_BEGIN _Pragma("OPENCL FP_CONTRACT OFF") _Pragma("clang fp reassociate(off)")
#define EXACT_END _Pragma("OPENCL FP_CONTRACT ON") _Pragma("clang fp reassociate(on)")
#else
#define EXACT_BEGIN _Pragma("OPENCL FP_CONTRACT OFF")
#if FLOAT_CONTRACT
#define EXACT_END _Pragma("OPENCL FP_CONTRACT ON")
#else
#define EXACT_END EXACT_BEGIN
#endif
#endif
EXACT_END
typedef float real;
typedef float3 real3;
#define REAL(x) x##f
#define REAL3(x, y, z) ((float3)(x, y, z))
#define REAL_MAX FLT_MAX
#define r_sqrt(x) sqrt(x)
#define r_abs(x) fabs(x)
#define r_floor(x) floor(x)
#define r_fma(a, b, c) fma(a, b, c)
#define real_bits(x) as_uint(x)
#define real_from_bits(x) as_float(x)
#else
#define EXACT_BEGIN
#define EXACT_END
#include "core/real_host.h"
#endif

INLINE real r_min(real a, real b) {
  return a < b ? a : b;
}
INLINE real r_max(real a, real b) {
  return a > b ? a : b;
}
INLINE real r_clamp(real x, real low, real high) {
  return r_min(r_max(x, low), high);
}
INLINE real sqr(real x) {
  return x * x;
}
/// sqrt of max(x, 0): for differences that rounding may push below zero.
INLINE real safe_sqrt(real x) {
  return r_sqrt(r_max(x, REAL(0.0)));
}
/// |x| with the sign of s (s = -0 counts as negative).
INLINE real sign_of(real x, real s) {
  return s < REAL(0.0) ? -r_abs(x) : r_abs(x);
}

/// Upper word of the 64-bit product: floor(a / 2^32 * b).
INLINE uint high_word(uint a, uint b) {
#if PELLUCID_DEVICE
  return mul_hi(a, b);
#else
  return (uint)(((std::uint64_t)a * b) >> 32);
#endif
}

/// Finite by bit pattern: isnan may be folded away where a device assumes finite maths.
INLINE int is_finite(real x) {
#if PELLUCID_DEVICE
  return (as_uint(x) & 0x7f800000u) != 0x7f800000u;
#else
  return host_is_finite(x);
#endif
}

INLINE real3 load3(F4 v) {
  return REAL3(v.x, v.y, v.z);
}
INLINE real dot3(real3 a, real3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
INLINE real3 cross3(real3 a, real3 b) {
  return REAL3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
INLINE real length3(real3 a) {
  return r_sqrt(dot3(a, a));
}
INLINE real3 normalize3(real3 a) {
  return a * (REAL(1.0) / r_sqrt(dot3(a, a)));
}
INLINE real3 abs3(real3 a) {
  return REAL3(r_abs(a.x), r_abs(a.y), r_abs(a.z));
}
INLINE real mean3(real3 a) {
  return (a.x + a.y + a.z) * (REAL(1.0) / REAL(3.0));
}
INLINE real max3(real3 a) {
  return r_max(a.x, r_max(a.y, a.z));
}
INLINE int is_black(real3 a) {
  return a.x == REAL(0.0) && a.y == REAL(0.0) && a.z == REAL(0.0);
}

#endif

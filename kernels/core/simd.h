// Vectors of BVH_WIDTH or LEAF_WIDTH lanes: OpenCL vector types on the device, a small struct in
// the twin. A comparison goes straight to a bit mask, bit i for lane i; x86 CPUs have an
// instruction for it, the portable form stands beside it and is what other devices (and the tests)
// use.
#ifndef PELLUCID_CORE_SIMD_H
#define PELLUCID_CORE_SIMD_H

#include "core/real.h"

#ifndef SIMD_WIDTH
#error "SIMD_WIDTH (lanes of a node and of a leaf block: 4, 8 or 16) must be set by the prelude"
#endif

#if PELLUCID_DEVICE

#define SIMD_CAT_(a, b) a##b
#define SIMD_CAT(a, b) SIMD_CAT_(a, b)
typedef SIMD_CAT(float, SIMD_WIDTH) vreal;
typedef SIMD_CAT(int, SIMD_WIDTH) vint;

#define v_splat(x) ((vreal)(x))
#define v_fma(a, b, c) fma(a, b, c)
INLINE vreal v_load(__global const float* p) {
  return *(__global const vreal*)p;
}
INLINE vreal v_min(vreal a, vreal b) {
  return a < b ? a : b;
}  // one instruction; fmin is three
INLINE vreal v_max(vreal a, vreal b) {
  return a > b ? a : b;
}
/// a where it is not zero, else b.
INLINE vreal v_if_zero(vreal a, vreal b) {
  return a == (vreal)(0.0f) ? b : a;
}

#if SIMD_BUILTINS && defined(__AVX512F__) && SIMD_WIDTH == 16
#define v_mask_le(a, b) ((uint)(ushort)__builtin_ia32_cmpps512_mask((a), (b), 2, (ushort)-1, 4))
#define v_mask_lt(a, b) ((uint)(ushort)__builtin_ia32_cmpps512_mask((a), (b), 1, (ushort)-1, 4))
#elif SIMD_BUILTINS && defined(__AVX__) && SIMD_WIDTH == 8
#define v_mask_le(a, b) ((uint)__builtin_ia32_movmskps256(as_float8((a) <= (b))))
#define v_mask_lt(a, b) ((uint)__builtin_ia32_movmskps256(as_float8((a) < (b))))
#elif SIMD_BUILTINS && defined(__SSE__) && SIMD_WIDTH == 4
#define v_mask_le(a, b) ((uint)__builtin_ia32_movmskps(as_float4((a) <= (b))))
#define v_mask_lt(a, b) ((uint)__builtin_ia32_movmskps(as_float4((a) < (b))))
#else
INLINE uint v_mask(vint m) {
#if SIMD_WIDTH == 16
  m &= (vint)(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768);
  int8 a = m.lo | m.hi;
  int4 b = a.lo | a.hi;
#elif SIMD_WIDTH == 8
  m &= (vint)(1, 2, 4, 8, 16, 32, 64, 128);
  int4 b = m.lo | m.hi;
#else
  int4 b = m & (vint)(1, 2, 4, 8);
#endif
  return (uint)(b.x | b.y | b.z | b.w);
}
#define v_mask_le(a, b) v_mask((a) <= (b))
#define v_mask_lt(a, b) v_mask((a) < (b))
#endif

/// Lanes to an array, for access by index.
INLINE void v_store(vreal v, PRIVATE real* out) {
  *(PRIVATE vreal*)out = v;
}
#define SIMD_ALIGNED __attribute__((aligned(4 * SIMD_WIDTH)))

#else

struct vreal {
  real lane[SIMD_WIDTH];
};
template <class F>
inline vreal v_map(F f) {
  vreal r;
  for (int i = 0; i < SIMD_WIDTH; ++i) r.lane[i] = f(i);
  return r;
}
inline vreal v_splat(real x) {
  return v_map([=](int) { return x; });
}
inline vreal v_load(const float* p) {
  return v_map([=](int i) { return real(p[i]); });
}
inline vreal operator+(vreal a, vreal b) {
  return v_map([&](int i) { return a.lane[i] + b.lane[i]; });
}
inline vreal operator-(vreal a, vreal b) {
  return v_map([&](int i) { return a.lane[i] - b.lane[i]; });
}
inline vreal operator*(vreal a, vreal b) {
  return v_map([&](int i) { return a.lane[i] * b.lane[i]; });
}
inline vreal operator/(vreal a, vreal b) {
  return v_map([&](int i) { return a.lane[i] / b.lane[i]; });
}
inline vreal operator-(vreal a) {
  return v_map([&](int i) { return -a.lane[i]; });
}
inline vreal v_fma(vreal a, vreal b, vreal c) {
  return v_map([&](int i) { return r_fma(a.lane[i], b.lane[i], c.lane[i]); });
}
inline vreal v_min(vreal a, vreal b) {
  return v_map([&](int i) { return r_min(a.lane[i], b.lane[i]); });
}
inline vreal v_max(vreal a, vreal b) {
  return v_map([&](int i) { return r_max(a.lane[i], b.lane[i]); });
}
inline vreal v_if_zero(vreal a, vreal b) {
  return v_map([&](int i) { return a.lane[i] == 0 ? b.lane[i] : a.lane[i]; });
}
inline uint v_mask_le(vreal a, vreal b) {
  uint m = 0;
  for (int i = 0; i < SIMD_WIDTH; ++i) m |= uint(a.lane[i] <= b.lane[i]) << i;
  return m;
}
inline uint v_mask_lt(vreal a, vreal b) {
  uint m = 0;
  for (int i = 0; i < SIMD_WIDTH; ++i) m |= uint(a.lane[i] < b.lane[i]) << i;
  return m;
}
inline void v_store(vreal v, real* out) {
  for (int i = 0; i < SIMD_WIDTH; ++i) out[i] = v.lane[i];
}
#define SIMD_ALIGNED

#endif

/// Index of the lowest set bit of m != 0.
INLINE uint lowest_bit(uint m) {
#if PELLUCID_DEVICE
  return 31u - clz(m & (0u - m));
#else
  return uint(__builtin_ctz(m));
#endif
}

#endif

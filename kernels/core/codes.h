// Small codes for what need not be exact: directions, colours and densities in few bits.
#ifndef PELLUCID_CORE_CODES_H
#define PELLUCID_CORE_CODES_H

#include "core/real.h"

INLINE uint float_bits(float x) {
#if PELLUCID_DEVICE
  return as_uint(x);
#else
  uint bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
#endif
}
INLINE float float_from_bits(uint bits) {
#if PELLUCID_DEVICE
  return as_float(bits);
#else
  float x;
  std::memcpy(&x, &bits, sizeof x);
  return x;
#endif
}

/// x in [-1, 1] to 16 bits, rounded; -1, 0 and 1 are kept.
INLINE uint snorm16(real x) {
  return (uint)(int)r_floor(r_clamp(x, REAL(-1.0), REAL(1.0)) * REAL(32767.0) + REAL(32768.5));
}
INLINE real from_snorm16(uint bits) {
  return ((real)bits - REAL(32768.0)) * REAL(3.0518509475997192e-5); /* 1 / 32767 */
}

/// A unit direction in 2 x 16 bits: the octahedron unfolded to a square [Cigolle14]. Off by at most
/// sqrt(18) half steps = 6.5e-5 rad, in the middle of its faces.
INLINE uint octahedral_pack(real3 d) {
  real inv = REAL(1.0) / (r_abs(d.x) + r_abs(d.y) + r_abs(d.z));
  real x = d.x * inv, y = d.y * inv;
  if (d.z < REAL(0.0)) {
    real folded = sign_of(REAL(1.0) - r_abs(y), x);
    y = sign_of(REAL(1.0) - r_abs(x), y);
    x = folded;
  }
  return snorm16(x) | (snorm16(y) << 16);
}
INLINE real3 octahedral_unpack(uint bits) {
  real x = from_snorm16(bits & 0xffffu), y = from_snorm16(bits >> 16);
  real z = REAL(1.0) - r_abs(x) - r_abs(y);
  if (z < REAL(0.0)) {
    real folded = sign_of(REAL(1.0) - r_abs(y), x);
    y = sign_of(REAL(1.0) - r_abs(x), y);
    x = folded;
  }
  return normalize3(REAL3(x, y, z));
}

/// A positive float to its upper 24 bits, rounded; the low 8 are free.
INLINE uint float24_pack(float x) {
  uint bits = float_bits(x);
  return bits >= 0x7f7fff80u ? 0x7f7fff00u : (bits + 0x80u) & 0xffffff00u;
}

/// Biased exponent of the least power of two that is not below x >= 0.
INLINE uint float_exponent_above(float x) {
  uint bits = float_bits(x);
  return (bits + 0x7fffffu) >> 23;
}

/// A float as a half, rounded; beyond their range the largest.
INLINE uint half_pack(float x) {
  uint bits = float_bits(x), sign = (bits >> 16) & 0x8000u, size = bits & 0x7fffffffu;
  if (size >= 0x477ff000u) return sign | 0x7bffu;  // 65520
  if (size < 0x38800000u)                          // 2^-14: steps of 2^-24
    return sign | (uint)(float_from_bits(size) * 16777216.0f + 0.5f);
  return sign | ((size - 0x38000000u + 0x1000u) >> 13);
}
/// Exact value of a half float that is not negative, infinite or NaN: 11 bits times powers of two,
/// in arithmetic that every device has and that meets no subnormal float.
INLINE real half_value(uint h) {
  uint exponent = h >> 10, fraction = h & 0x3ffu;
  uint digits = exponent ? fraction | 0x400u : fraction;
  return (real)digits * (real)(1u << (exponent ? exponent : 1u)) * REAL(2.98023223876953125e-8);
}
INLINE real half_unpack(uint bits) {
  real size = half_value(bits & 0x7fffu);
  return (bits & 0x8000u) ? -size : size;
}

/// A colour >= 0 as three mantissas of 8 bits under the exponent of the largest [Ward91], rounded:
/// off by at most 1/255 of that.
INLINE uint rgbe_pack(real3 c) {
  uint exponent = float_bits((float)max3(c)) >> 23;             // largest < 2^(exponent - 126)
  if (exponent < 9u) return 0u;                                 // below 2^-118: black
  real scale = (real)float_from_bits((261u - exponent) << 23);  // 2^(134 - exponent)
  if (max3(c) * scale >= REAL(255.5)) {                         // the largest would round up to 256
    scale = scale * REAL(0.5);
    ++exponent;
  }
  uint r = (uint)(c.x * scale + REAL(0.5)), g = (uint)(c.y * scale + REAL(0.5)),
       b = (uint)(c.z * scale + REAL(0.5));
  return r | (g << 8) | (b << 16) | (exponent << 24);
}
INLINE real3 rgbe_unpack(uint bits) {
  uint exponent = bits >> 24;
  if (exponent < 9u) return REAL3(0.0f, 0.0f, 0.0f);
  real step = (real)float_from_bits((exponent - 7u) << 23);  // 2^(exponent - 134)
  return REAL3((real)(bits & 0xffu), (real)((bits >> 8) & 0xffu), (real)((bits >> 16) & 0xffu)) *
         step;
}

#endif

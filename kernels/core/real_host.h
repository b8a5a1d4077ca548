// The host's side of core/real.h (the twin, pack/triangle_start.cpp): real and real3 for C++.
// Compile with -DPELLUCID_REAL=float or double; everything lands in a namespace of its own, so both
// can live in one program.
#ifndef PELLUCID_CORE_REAL_HOST_H
#define PELLUCID_CORE_REAL_HOST_H

// With float also define PELLUCID_REAL_IS_FLOAT (the preprocessor cannot compare types).

#include <cmath>
#include <cstring>
#include <limits>

#ifndef PELLUCID_REAL
#error "the twin needs PELLUCID_REAL (float or double)"
#endif

using real = PELLUCID_REAL;

#define REAL(x) real(x)
#define REAL3(x, y, z) (real3{real(x), real(y), real(z)})
#define REAL_MAX (std::numeric_limits<real>::max())

struct real3 {
  real x, y, z;
};
inline real3 operator+(real3 a, real3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline real3 operator-(real3 a, real3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline real3 operator*(real3 a, real3 b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline real3 operator/(real3 a, real3 b) {
  return {a.x / b.x, a.y / b.y, a.z / b.z};
}
inline real3 operator*(real3 a, real s) {
  return {a.x * s, a.y * s, a.z * s};
}
inline real3 operator*(real s, real3 a) {
  return a * s;
}
inline real3 operator/(real3 a, real s) {
  return {a.x / s, a.y / s, a.z / s};
}
inline real3 operator+(real3 a, real s) {
  return {a.x + s, a.y + s, a.z + s};
}
inline real3 operator-(real3 a, real s) {
  return {a.x - s, a.y - s, a.z - s};
}
inline real3 operator-(real3 a) {
  return {-a.x, -a.y, -a.z};
}
inline real3& operator+=(real3& a, real3 b) {
  return a = a + b;
}
inline real3& operator*=(real3& a, real3 b) {
  return a = a * b;
}
inline real3& operator*=(real3& a, real s) {
  return a = a * s;
}

inline real r_sqrt(real x) {
  return std::sqrt(x);
}
inline real r_abs(real x) {
  return std::abs(x);
}
inline real r_floor(real x) {
  return std::floor(x);
}
inline real r_fma(real a, real b, real c) {
  return std::fma(a, b, c);
}
#ifdef PELLUCID_REAL_IS_FLOAT
inline uint real_bits(float x) {
  uint u;
  std::memcpy(&u, &x, sizeof u);
  return u;
}
inline float real_from_bits(uint u) {
  float x;
  std::memcpy(&x, &u, sizeof x);
  return x;
}
#endif
inline int host_is_finite(real x) {
  return std::isfinite(x);
}

#endif

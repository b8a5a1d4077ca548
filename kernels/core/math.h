// Functions of our own where the device library is slow (PoCL's scalar pow takes 130 ns) or differs
// between devices. Float: polynomials, errors in ulps stated and tested against double. In the
// double twin they are the standard library's.
#ifndef PELLUCID_CORE_MATH_H
#define PELLUCID_CORE_MATH_H

#include "core/real.h"

#define PI REAL(3.14159265358979323846)
#define TWO_PI REAL(6.28318530717958647692)
#define FOUR_PI REAL(12.56637061435917295385)
#define INV_PI REAL(0.31830988618379067154)
#define INV_TWO_PI REAL(0.15915494309189533577)
#define INV_FOUR_PI REAL(0.07957747154594766788)

typedef struct SinCos {
  real s, c;
} SinCos;

#if PELLUCID_DEVICE || defined(PELLUCID_REAL_IS_FLOAT)

/// sin and cos of 2 pi u for u in [0, 1], absolute error below 1.5 * 2^-24: quadrant in exact
/// arithmetic, 2 pi in two floats, then Taylor-like polynomials on [-pi/4, pi/4].
INLINE SinCos sincos_2pi(float u) {
  int quadrant = (int)(u * 4.0f + 0.5f);
  float rest = u - 0.25f * (float)quadrant;
  float a = r_fma(rest, 6.28318548202514648438f, rest * -1.7484555e-7f);
  float a2 = a * a;
  float s =
      a +
      a * a2 *
          r_fma(a2,
                r_fma(a2, r_fma(a2, 2.6083159809786593541503e-06f, -1.981069071916863322258e-04f),
                      8.333078585565090179443e-03f),
                -1.666665971279144287109e-01f);
  float c = 1.0f + a2 * r_fma(a2,
                              r_fma(a2, r_fma(a2, 2.443315711809948e-05f, -1.388731625493765e-03f),
                                    4.166664568298827e-02f),
                              -0.5f);
  SinCos r;
  int odd = quadrant & 1;
  float x = odd ? c : s, y = odd ? s : c;
  r.s = (quadrant & 2) ? -x : x;
  r.c = ((quadrant + 1) & 2) ? -y : y;
  return r;
}

/// Angle of the point (x, y) in turns, from -1/2 to 1/2, 0 for (0, 0); absolute error below 2^-24.
/// Octant by exact symmetries, half of that by the addition theorem, then an odd minimax
/// polynomial.
INLINE float atan2_turns(float y, float x) {
  float ax = r_abs(x), ay = r_abs(y);
  float low = r_min(ax, ay), high = r_max(ax, ay);
  if (high == 0.0f) return 0.0f;
  int upper = low > 0.41421356f * high;  // tan(pi/8)
  float t = upper ? (low - high) / (low + high) : low / high;
  float t2 = t * t;
  float p = r_fma(t2, 0.0126946626859f, -0.0220405567164f);
  p = r_fma(t2, p, 0.0317897395015f);
  p = r_fma(t2, p, -0.0530507762263f);
  p = t * r_fma(t2, p, 0.15915494011f);
  float turns = upper ? 0.125f + p : p;
  turns = ay > ax ? 0.25f - turns : turns;
  turns = x < 0.0f ? 0.5f - turns : turns;
  return y < 0.0f ? -turns : turns;
}

EXACT_BEGIN

/// log2 of a normal positive float as high + low, relative error below 2^-27: pow multiplies it by
/// up to 126 / log2(x) and must still know the fraction to half an ulp.
INLINE float log2_split(float x, PRIVATE float* low) {
  uint bits = real_bits(x);
  int e = (int)((bits - 0x3f3504f3u) >> 23);  // mantissa into [sqrt(1/2), sqrt(2))
  e = (bits < 0x3f3504f3u) ? e - 512 : e;
  float m = real_from_bits(bits - ((uint)e << 23));
  float m1 = m + 1.0f;
  float m1_low = m - (m1 - 1.0f);  // what rounding m + 1 lost
  float f = (m - 1.0f) / m1;       // |f| < 0.1716
  float f2 = f * f;
  // log2(m) = 2/ln2 (f + f^3/3 + f^5/5 + ...); the leading term keeps its rounding error in `low`.
  float lead = 2.885390043258667f * f;
  float lead_low = r_fma(2.885390043258667f, f, -lead) + 3.851925e-8f * f;
  float f_error = (r_fma(-f, m1, m - 1.0f) - f * m1_low) / m1;
  float tail =
      f * f2 *
      r_fma(f2, r_fma(f2, r_fma(f2, r_fma(f2, 0.26230819f, 0.32059890f), 0.41219858f), 0.57707802f),
            0.96179669f);
  float fe = (float)e;
  float sum = fe + lead;
  float slope = r_fma(2.8853900f, f2, 2.8853900f);  // of lead + tail by f, which f_error corrects
  float rest = ((fe - sum) + lead) + (r_fma(slope, f_error, lead_low) + tail);
  float high = sum + rest;  // now |low| <= half an ulp of high, whatever y multiplies it
  *low = rest - (high - sum);
  return high;
}

/// 2^(x + low) for x in [-126, 127] and |low| far below 1, 1 ulp; below it 0, above it clipped to
/// 2^127.
INLINE float exp2_split(float x, float low) {
  if (x < -126.0f) return 0.0f;
  x = r_min(x, 127.0f);
  int i = (int)(x + (x < 0.0f ? -0.5f : 0.5f));
  float f = (x - (float)i) + low;  // [-0.5, 0.5]
  float p = r_fma(f, 1.5252733804e-5f, 1.5403530394e-4f);
  p = r_fma(f, p, 1.3333558146e-3f);
  p = r_fma(f, p, 9.6181291076e-3f);
  p = r_fma(f, p, 5.5504108665e-2f);
  p = r_fma(f, p, 2.4022650696e-1f);
  p = r_fma(f, p, 6.9314718056e-1f);
  p = r_fma(f, p, 1.0f);
  return p * real_from_bits((uint)(i + 127) << 23);
}

/// x^y for x in [0, 1] and y >= 0 (0^0 = 1), to 4 ulp where the result is a normal number.
INLINE float pow_unit(float x, float y) {
  if (y == 0.0f) return 1.0f;
  if (x < 1.17549435e-38f) return 0.0f;
  float low;
  float high = log2_split(x, &low);
  float p = high * y;
  float p_low = r_fma(high, y, -p) + low * y;
  return exp2_split(p, p_low);
}

EXACT_END

/// acos x for x in [0, 1], absolute error below 4 * 2^-24 [Abramowitz64 4.4.46]. No power of 1 - x
/// is lost where the angle is small.
INLINE float acos_unit(float x) {
  float p = r_fma(x, -0.0012624911f, 0.0066700901f);
  p = r_fma(x, p, -0.0170881256f);
  p = r_fma(x, p, 0.0308918810f);
  p = r_fma(x, p, -0.0501743046f);
  p = r_fma(x, p, 0.0889789874f);
  p = r_fma(x, p, -0.2145988016f);
  p = r_fma(x, p, 1.5707963050f);
  return p * r_sqrt(1.0f - x);
}

#else

INLINE SinCos sincos_2pi(real u) {
  SinCos r = {std::sin(TWO_PI * u), std::cos(TWO_PI * u)};
  return r;
}
INLINE real atan2_turns(real y, real x) {
  return std::atan2(y + REAL(0.0), x) * INV_TWO_PI;  // + 0: -0 is not below the axis
}
INLINE real pow_unit(real x, real y) {
  return std::pow(x, y);
}
INLINE real acos_unit(real x) {
  return std::acos(x);
}

#endif

#endif

// Wide unsigned integers, least significant word first: the film's sums. Integers add to the same
// bits in any order and any grouping, so passes may be split, resumed and merged at will; two
// floats per sum, however carefully added, do not have that.
#ifndef PELLUCID_SHARED_WIDE_H
#define PELLUCID_SHARED_WIDE_H

#include "shared/platform.h"

/// Mantissa and exponent of what a sum holds or gets: value = mantissa * 2^exponent.
typedef struct WideValue {
  ulong mantissa;
  int exponent;
} WideValue;

/// A finite float >= 0, given by its bits. The mantissa has at most 24 bits.
INLINE WideValue wide_from_float(uint bits) {
  WideValue v;
  uint biased = (bits >> 23) & 0xffu;
  v.mantissa = (bits & 0x7fffffu) | (biased ? 0x800000u : 0u);
  v.exponent = (int)(biased ? biased : 1u) - 150;
  return v;
}

/// The value as a multiple of 2^0, rounded to the nearest (ties up) where it has a fraction.
INLINE WideValue wide_round(WideValue v) {
  if (v.exponent >= 0) return v;
  int drop = -v.exponent;
  v.mantissa = drop < 64 ? (v.mantissa >> drop) + ((v.mantissa >> (drop - 1)) & 1u) : 0u;
  v.exponent = 0;
  return v;
}

/// sum += v for a value without a fraction. The caller knows that it fits into `words`.
INLINE void wide_add(GLOBAL uint* sum, int words, WideValue v) {
  int word = v.exponent >> 5, shift = v.exponent & 31;
  ulong low = v.mantissa << shift;
  ulong high = shift ? v.mantissa >> (64 - shift) : 0u;
  ulong carry = 0;
  for (int i = 0; word + i < words; ++i) {
    ulong part = i == 0 ? (uint)low : i == 1 ? low >> 32 : i == 2 ? high : 0u;
    if (i > 2 && carry == 0) break;
    carry += (ulong)sum[word + i] + part;
    sum[word + i] = (uint)carry;
    carry >>= 32;
  }
}

/// sum += other, word by word.
INLINE void wide_add_words(GLOBAL uint* sum, GLOBAL const uint* other, int words) {
  ulong carry = 0;
  for (int i = 0; i < words; ++i) {
    carry += (ulong)sum[i] + other[i];
    sum[i] = (uint)carry;
    carry >>= 32;
  }
}

/// The upper 32 bits of a sum; what lies below is cut off, at most 2^-31 of it.
INLINE WideValue wide_top(GLOBAL const uint* sum, int words) {
  WideValue v;
  v.mantissa = 0;
  v.exponent = 0;
  int i = words - 1;
  while (i > 0 && sum[i] == 0u) --i;
  if (i == 0) {
    v.mantissa = sum[0];
    return v;
  }
  ulong two = ((ulong)sum[i] << 32) | sum[i - 1];
  int extra = 0;
  while ((two >> extra) > 0xffffffffu) ++extra;
  v.mantissa = two >> extra;
  v.exponent = extra + 32 * (i - 1);
  return v;
}

/// The square of a value of at most 32 bits, in units of 2^drop and rounded to one.
INLINE WideValue wide_square(WideValue v, int drop) {
  v.mantissa *= v.mantissa;
  v.exponent = 2 * v.exponent - drop;
  return wide_round(v);
}

#endif

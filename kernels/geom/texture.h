// Image textures: wrapping, bilinear filter, and texels stored as half floats.
#ifndef PELLUCID_GEOM_TEXTURE_H
#define PELLUCID_GEOM_TEXTURE_H

#include "core/codes.h"
#include "geom/scene_data.h"

#if FEAT_TEXTURE

INLINE real3 texel_at(PRIVATE const SceneData* scene, Texture t, int x, int y) {
  GLOBAL const uint* texel = scene->texels + (size_t)2 * (t.first + (uint)y * t.width + (uint)x);
  return REAL3(half_value(texel[0] & 0xffffu), half_value(texel[0] >> 16), half_value(texel[1]));
}

/// Brings a coordinate into [0, 1].
INLINE real texture_fold(uint wrap, real u) {
  if (wrap == TEXTURE_REPEAT) return u - r_floor(u);
  // Mirror: the distance to the nearest even number.
  if (wrap == TEXTURE_MIRROR) return r_abs(u - REAL(2.0) * r_floor(REAL(0.5) * u + REAL(0.5)));
  return r_clamp(u, REAL(0.0), REAL(1.0));
}

/// Index of a texel at most one beside the image. A mirrored image meets itself at its border, so
/// there, too, the outermost texel goes on.
INLINE int texture_wrap(uint wrap, int i, uint size) {
  int last = (int)size - 1;
  if (wrap == TEXTURE_REPEAT) return i < 0 ? last : i > last ? 0 : i;
  return i < 0 ? 0 : i > last ? last : i;
}

INLINE real3 texture_mix(real3 a, real3 b, real f) {
  return a + (b - a) * f;  // exactly a where both are the same
}

/// Colour at (u, v). Texel centres lie at half-integers: texel i covers [i, i + 1] / size.
INLINE real3 texture_at(PRIVATE const SceneData* scene, uint index, real u, real v) {
  Texture t = scene->textures[index];
  uint wrap = t.mode & TEXTURE_WRAP_MASK;
  F4 m = t.scale_offset;
  real x = texture_fold(wrap, u * (real)m.x + (real)m.z) * (real)t.width;
  real y = texture_fold(wrap, v * (real)m.y + (real)m.w) * (real)t.height;
  real shift = (t.mode & TEXTURE_NEAREST) ? REAL(0.0) : REAL(0.5);
  real floor_x = r_floor(x - shift), floor_y = r_floor(y - shift);
  int x0 = texture_wrap(wrap, (int)floor_x, t.width);
  int y0 = texture_wrap(wrap, (int)floor_y, t.height);
  if (t.mode & TEXTURE_NEAREST) return texel_at(scene, t, x0, y0);
  int x1 = texture_wrap(wrap, (int)floor_x + 1, t.width);
  int y1 = texture_wrap(wrap, (int)floor_y + 1, t.height);
  real fx = x - shift - floor_x, fy = y - shift - floor_y;
  real3 below = texture_mix(texel_at(scene, t, x0, y0), texel_at(scene, t, x1, y0), fx);
  real3 above = texture_mix(texel_at(scene, t, x0, y1), texel_at(scene, t, x1, y1), fx);
  return texture_mix(below, above, fy);
}

#endif

#endif

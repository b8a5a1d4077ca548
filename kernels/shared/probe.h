// What the device is asked about before it is trusted: the layout of every shared struct and of the
// first field of each 16-byte row, and the arithmetic and functions that kernels use.
#ifndef PELLUCID_SHARED_PROBE_H
#define PELLUCID_SHARED_PROBE_H

// clang-format off
#define LAYOUT_STRUCTS(X) \
  X(Triangle) X(Quadric) X(Shape) X(Material) X(Texture) X(Light) X(SceneInfo) X(Camera) X(Launch) X(FilmPixel) \
  X(AovPixel) X(PathEvent) X(PathVertex) X(CompactVertex) X(Photon)

#define LAYOUT_FIELDS(X)                                                                  \
  X(Triangle, shape)                                                                      \
  X(Quadric, normal) X(Quadric, tangent) X(Quadric, kind) X(Quadric, shape)               \
  X(Shape, first_light)                                                                   \
  X(Material, survive) X(Material, reflectance) X(Material, eta_specular) X(Material, k)  \
  X(Material, part_count) X(Material, texture) X(Texture, mode) X(Texture, scale_offset)  \
  X(Light, alias) X(Light, value) X(Light, position) X(Light, axis)                       \
  X(SceneInfo, center_radius) X(SceneInfo, root) X(SceneInfo, environment)                \
  X(Camera, corner) X(Camera, dx) X(Camera, dy) X(Camera, forward)                        \
  X(Launch, tile_width) X(Launch, max_depth) X(Launch, splat_scale) X(Launch, film_lsb)       \
  X(Launch, window_x) X(Launch, slice_first) X(Launch, path_count) X(Launch, store_end) X(Launch, radius) X(Launch, grid_x) X(Launch, grid_bits)   \
  X(Launch, layer_set) X(Launch, record_capacity)X(Launch, item_first)                                              \
  X(PathVertex, ng_u) X(PathVertex, ns_v) X(PathVertex, wo_dVCM) X(PathVertex, beta_dVC)  \
  X(PathVertex, material) X(CompactVertex, ng) X(CompactVertex, beta)                     \
  X(FilmPixel, block) X(FilmPixel, square) X(FilmPixel, count) X(FilmPixel, peak)         \
  X(PathEvent, partner) X(PathEvent, p) X(PathEvent, value) X(PathEvent, brought)         \
  X(AovPixel, normal) X(AovPixel, geometric) X(AovPixel, albedo) X(AovPixel, id)
// clang-format on

// X(name, unit, bound, loose, meaning): `bound` is what kernels count on, in ulps of the result or
// in roundoffs of 1 (2^-24); `loose` holds where division and roots are not correctly rounded,
// OpenCL's own bounds, or with --float fast. fma has to be one rounding: edge functions are settled
// by it.
#define MATH_PROBES(X)                                                        \
  X(divide, ULPS, 0.5, 2.5, "x / y")                                          \
  X(sqrt, ULPS, 0.5, 3.0, "sqrt")                                             \
  X(fma, ULPS, 0.0, 0.0, "fma(x, y, -xy), which is what rounding of xy lost") \
  X(floor, ULPS, 0.0, 0.0, "floor")                                           \
  X(sin, ROUNDOFFS, 1.5, 2.5, "sin of turns")                                 \
  X(cos, ROUNDOFFS, 1.5, 2.5, "cos of turns")                                 \
  X(atan2, ROUNDOFFS, 1.0, 2.0, "atan2 in turns")                             \
  X(pow, ULPS, 4.0, 6.0, "pow for 0 to 1")                                    \
  X(acos, ROUNDOFFS, 4.0, 5.0, "acos for 0 to 1")

#endif

// The one list of everything that can be compiled into or out of a kernel. Host enum, log,
// --features, docs and the kernels' prelude all expand from it. Every flag is always defined, 0 or
// 1: kernels say
// `#if FEAT_X`, never `#ifdef`.
#ifndef PELLUCID_SHARED_FEATURES_H
#define PELLUCID_SHARED_FEATURES_H

// X(name, meaning). FEAT_: an effect that the scene has. INTG_: what the integrator asks for.
#define FEATURES(X)                                                              \
  X(FEAT_TRIANGLES, "triangle meshes")                                           \
  X(FEAT_SPHERES, "analytic spheres")                                            \
  X(FEAT_DISKS, "analytic disks")                                                \
  X(FEAT_SMOOTH_NORMALS, "interpolated shading normals")                         \
  X(FEAT_TEXTURE, "image textures")                                              \
  X(FEAT_ONE_SIDED, "opaque surfaces that are black from behind")                \
  X(FEAT_DIFFUSE, "Lambertian reflection")                                       \
  X(FEAT_OREN_NAYAR, "rough diffuse reflection")                                 \
  X(FEAT_PHONG, "modified Phong reflection")                                     \
  X(FEAT_PLASTIC, "diffuse bases under a smooth coat")                           \
  X(FEAT_ROUGH_PLASTIC, "diffuse bases under a GGX coat")                        \
  X(FEAT_MIRROR, "perfect mirrors")                                              \
  X(FEAT_CONDUCTOR, "smooth metals")                                             \
  X(FEAT_ROUGH_CONDUCTOR, "GGX metals")                                          \
  X(FEAT_DIELECTRIC, "smooth glass")                                             \
  X(FEAT_ROUGH_DIELECTRIC, "GGX glass")                                          \
  X(FEAT_THIN_DIELECTRIC, "panes of glass without thickness")                    \
  X(FEAT_MIX, "mixes of materials")                                              \
  X(FEAT_LIGHT_TRIANGLE, "emitting triangles")                                   \
  X(FEAT_LIGHT_SPHERE, "emitting spheres")                                       \
  X(FEAT_LIGHT_DISK, "emitting disks")                                           \
  X(FEAT_LIGHT_POINT, "point lights")                                            \
  X(FEAT_LIGHT_SPOT, "spot lights")                                              \
  X(FEAT_LIGHT_DIRECTIONAL, "directional lights")                                \
  X(FEAT_LIGHT_ENVIRONMENT, "a constant environment")                            \
  X(INTG_NEE, "next event estimation: a light sample at every non-delta vertex") \
  X(INTG_MIS, "emission found by chance and by NEE, weighted together")          \
  X(INTG_UNIFORM, "directions drawn uniformly, without importance sampling")     \
  X(INTG_SPLAT, "contributions splatted to any pixel")                           \
  X(INTG_CONNECT, "eye and light paths connected at every pair of vertices")     \
  X(INTG_MERGE, "eye vertices merged with the light vertices around them")       \
  X(INTG_COMPACT, "path vertices in half the bytes")                             \
  X(INTG_LAYERS, "radiance kept apart by path length and strategy")              \
  X(INTG_RECORD, "what paths do and bring, written down")                        \
  X(INTG_SOBOL, "Owen-scrambled Sobol points instead of random numbers")         \
  X(INTG_FILTER, "a pixel filter that is not the box")

#endif

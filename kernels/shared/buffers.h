// Bundles of buffers as X-macros: X(element type, name, meaning [shape]). One list yields the
// kernel parameters, the device-side struct of pointers and the host binding; nobody counts
// arguments.
#ifndef PELLUCID_SHARED_BUFFERS_H
#define PELLUCID_SHARED_BUFFERS_H

#include "shared/layout.h"

// Read only, made once by pack.
#define SCENE_BUFFERS(X)                                                                       \
  X(float, nodes, "BVH nodes [nodes][7][BVH_WIDTH]: x-, x+, y-, y+, z-, z+, child references") \
  X(float, leaves, "triangle blocks [blocks][3 vertices][3 axes][LEAF_WIDTH]")                 \
  X(uint, leaf_prims, "primitive ids [blocks][LEAF_WIDTH]")                                    \
  X(Quadric, quadrics, "analytic surfaces [quadrics]")                                         \
  X(Triangle, triangles, "triangles [triangles]")                                              \
  X(F4, positions, "vertices [vertices], world units")                                         \
  X(F4, normals, "unit vertex normals [vertices], only with FEAT_SMOOTH_NORMALS")              \
  X(float, uvs, "texture coordinates [vertices][2], up to the last textured one")              \
  X(Shape, shapes, "shapes [shapes]")                                                          \
  X(Material, materials, "materials [materials]")                                              \
  X(Texture, textures, "textures [textures]")                                                  \
  X(uint, texels, "linear colour as halfs [texels][2]: r + g 2^16, b")                         \
  X(Light, lights, "lights with their alias table [lights]")

// Read only, made once by pack: the pixel filter.
#define FILTER_BUFFERS(X)                                                                        \
  X(float, filter_table, "offsets from the pixel's centre (camera/filter.h) [FILTER_STEPS + 1]") \
  X(float, filter_values, "the filter from its centre to its radius [FILTER_STEPS + 1]")

// Read and written by the passes of an iteration.
#define FILM_BUFFERS(X)                                                        \
  X(F4, samples, "radiance of this iteration, w: rays traced for it [pixels]") \
  X(FilmPixel, film, "accumulators [pixels]")

#define SPLAT_WORDS 8
#define SPLAT_BUFFERS(X) \
  X(uint, splats, "64-bit whole numbers, low word first [pixels][r g b rays][2 words]")

// Vertices of the sub-paths of a slice. Tracing puts them wherever the next slot is; what makes
// them the same for any order of work is that they are read by path, in order, through the index.
#define LIGHT_VERTEX_BUFFERS(X)                                                            \
  X(F4, light_vertices, "PathVertex or CompactVertex [light capacity]")                    \
  X(uint, light_last, "slot of each light path's last vertex, or NONE [paths of a slice]") \
  X(uint, light_first, "their number; after vertex_scan the first's place [paths + 1]")    \
  X(uint, light_order, "slots path by path, in order [light capacity]")
#define EYE_VERTEX_BUFFERS(X)                                 \
  X(F4, eye_vertices, "the same of eye paths [eye capacity]") \
  X(uint, eye_last, "[pixels of a slice]")                    \
  X(uint, eye_first, "[pixels of a slice + 1]")               \
  X(uint, eye_order, "[eye capacity]")
// Light vertices by the cell of space that they lie in. Pairs: (cell, place in light_order); those
// that are never merged have cell NONE and stand behind all others, where lists by cell hold
// nothing.
#define GRID_BUFFERS(X)                                                                  \
  X(F4, photon_positions, "cell by cell [light capacity]")                               \
  X(Photon, photons, "in the same order [light capacity]")                               \
  X(uint, grid_pairs, "[light capacity][2]")                                             \
  X(uint, grid_sorted, "the same, sorted by a digit [light capacity][2]")                \
  X(uint, grid_digits, "how often each block has each digit [SORT_DIGITS][SORT_BLOCKS]") \
  X(uint, grid_cells, "first photon of each cell and the one after its last [cells][2]")
#define VERTEX_COUNT_BUFFERS(X) X(uint, vertex_counts, "slots asked for: light, eye [2]")

#define LAYER_BUFFERS(X) \
  X(uint, layers,        \
    "64-bit fixed point, low word first [pixels][layers][3 channels][2 words] (shared/layers.h)")

// What the paths of a replay do (transport/record.h).
#define RECORD_BUFFERS(X)                                                             \
  X(PathEvent, record, "of each path in order, paths mixed [Launch.record_capacity]") \
  X(uint, record_count, "events that wanted to be there [1]")

#define AOV_BUFFERS(X) X(AovPixel, aovs, "what camera rays meet first [pixels]")

#define DIAG_BUFFERS(X) \
  X(uint, diag, "counters of what went wrong, and sums of throughput cut off [DIAG_WORDS]")

// Counters: X(name, is an error, meaning). Errors fail a render under --strict.
#define DIAG_COUNTERS(X)                                                                     \
  X(nonfinite, 1, "samples dropped because they were NaN or infinite")                       \
  X(nonfinite_vertex, 1, "walks ended because a normal or direction was NaN or infinite")    \
  X(negative, 1, "samples dropped because they were negative")                               \
  X(stack_overflow, 1, "BVH subtrees skipped because the traversal stack was full")          \
  X(path_stuck, 1, "paths ended by the hard limit on path length")                           \
  X(escaped, 0, "rays that left the scene, which says that it is closed")                    \
  X(weight_outside, 1, "MIS weights below 0, above 1 or NaN")                                \
  X(film_saturated, 1, "samples cut because they exceed the film's range")                   \
  X(splat_outside, 1, "splats dropped because their pixel is outside the film")              \
  X(splat_saturated, 1, "splats cut, or sums of them wrapped, beyond the fixed-point range") \
  X(layer_dropped, 1, "parts of layers dropped: they were NaN, infinite or negative")        \
  X(layer_saturated, 1, "parts of layers cut because they exceed the fixed-point range")

#define DIAG_ENUM(name, error, meaning) DIAG_##name,
enum { DIAG_COUNTERS(DIAG_ENUM) DIAG_COUNT };

// Behind them: throughput that --max-depth cut off, as shares of what the paths started with. Whole
// numbers of 64 bits, so that sums do not depend on order: steps of 2^-32, low word first.
enum { CUT_camera, CUT_light, CUT_COUNT };
#define DIAG_CUTS ((DIAG_COUNT + 1) / 2 * 2) /* on 8 bytes, for 64-bit atomics */
#define DIAG_WORDS (DIAG_CUTS + 2 * CUT_COUNT)

/// Counts an event.
INLINE void diag_add(GLOBAL uint* diag, uint counter) {
#if PELLUCID_DEVICE
  atomic_inc(&diag[counter]);
#else
  ++diag[counter];
#endif
}

#endif

// Layers of a picture: radiance kept apart by path length and by strategy (s, t), and what pixels
// show of the data behind it. How they are numbered, for kernels that add to them and for the host
// that names them.
#ifndef PELLUCID_SHARED_LAYERS_H
#define PELLUCID_SHARED_LAYERS_H

#include "shared/platform.h"

// A strategy draws s vertices from the light's end, the point on the light included, and t from the
// camera's end, the lens included: a path of `depth` = s + t - 1 segments. s = t = 1 is never
// drawn, so length 1 has s = 0 alone and every other length has s = 0 .. depth.

// Kinds of layers, as bits.
#define LAYERS_LENGTH 1u    // radiance by path length; one more for longer paths
#define LAYERS_TECH 2u      // by strategy, weighted (one more for longer paths) and unweighted
#define LAYERS_VERTICES 4u  // how many light vertices the camera sees in a pixel
#define LAYERS_MERGE 8u     // with LAYERS_TECH: merges by eye vertex, weighted and unweighted
// Of the first vertex in a pixel that gathers photons:
#define LAYERS_PHOTONS 16u  // how many that can merge are within the radius
#define LAYERS_CELLS \
  32u  // pass 0: photons in its cell, in the cell's bucket, parity (LAYER_CELL_*)
#define LAYERS_RADIUS 64u  // the radius of merging in widths of a pixel

// Words of a pixel's layer of cells. Parity is 1 or 2, as the colours of a chess board are in
// space, so that neighbours differ; 0 where there is no vertex.
#define LAYER_CELL_PHOTONS 0u
#define LAYER_CELL_BUCKET 2u
#define LAYER_CELL_PARITY 4u
/// Radii count steps of 2^-20 of a pixel.
#define LAYER_RADIUS_STEPS 1048576.0f

/// Longest path length that may have layers of its own: some 1000 strategies.
#define LAYER_LENGTH_MAX 30u
/// Words of a layer in a pixel: three channels of 64 bits, low word first.
#define LAYER_WORDS 6u

/// A set of layers in one word (Launch.layer_set; 0: none): kinds, the longest length N with
/// layers of its own, and the most vertices s that the method draws from the light's end.
INLINE uint layer_set_of(uint kinds, uint longest, uint most_s) {
  return kinds | longest << 8u | most_s << 16u;
}
INLINE uint layer_kinds(uint set) {
  return set & 0xffu;
}
INLINE uint layer_longest(uint set) {
  return set >> 8u & 0xffu;
}
INLINE uint layer_most_s(uint set) {
  return set >> 16u;
}

/// Strategies of one length: s = 0 .. this - 1.
INLINE uint layer_strategies(uint set, uint depth) {
  uint most = layer_most_s(set);
  return depth < 2u ? 1u : (depth < most ? depth : most) + 1u;
}
/// Strategies of all lengths below `depth`.
INLINE uint layer_strategies_below(uint set, uint depth) {
  uint count = 0u;
  for (uint d = 1u; d < depth; ++d) count += layer_strategies(set, d);
  return count;
}

// Order: lengths 1 .. N, longer | strategies weighted, longer | strategies unweighted | merges at
// eye vertices 1 .. N weighted | unweighted | vertices | photons | cells | radius. Merges farther
// out are among the longer.

INLINE uint layer_of_length(uint set, uint depth) {
  uint longest = layer_longest(set);
  return depth > longest ? longest : depth - 1u;
}
/// The first layer of strategies.
INLINE uint layer_first_strategy(uint set) {
  return layer_kinds(set) & LAYERS_LENGTH ? layer_longest(set) + 1u : 0u;
}
INLINE uint layer_of_weighted(uint set, uint s, uint depth) {
  uint longest = layer_longest(set);
  return layer_first_strategy(set) + (depth > longest ? layer_strategies_below(set, longest + 1u)
                                                      : layer_strategies_below(set, depth) + s);
}
/// Longer paths have none: unweighted strategies add up to nothing.
INLINE uint layer_of_unweighted(uint set, uint s, uint depth) {
  return layer_of_weighted(set, 0u, layer_longest(set) + 1u) + 1u +
         layer_strategies_below(set, depth) + s;
}
INLINE uint layer_first_merge(uint set) {
  if (!(layer_kinds(set) & LAYERS_TECH)) return layer_first_strategy(set);
  return layer_of_unweighted(set, 0u, layer_longest(set) + 1u);
}
/// Merges at eye vertex k >= 1, of any path length.
INLINE uint layer_of_merge(uint set, uint k) {
  uint longest = layer_longest(set);
  return k > longest ? layer_of_weighted(set, 0u, longest + 1u) : layer_first_merge(set) + k - 1u;
}
INLINE uint layer_of_merge_unweighted(uint set, uint k) {
  return layer_first_merge(set) + layer_longest(set) + k - 1u;
}
INLINE uint layer_of_vertices(uint set) {
  return layer_first_merge(set) + (layer_kinds(set) & LAYERS_MERGE ? 2u * layer_longest(set) : 0u);
}
INLINE uint layer_of_photons(uint set) {
  return layer_of_vertices(set) + (layer_kinds(set) & LAYERS_VERTICES ? 1u : 0u);
}
INLINE uint layer_of_cells(uint set) {
  return layer_of_photons(set) + (layer_kinds(set) & LAYERS_PHOTONS ? 1u : 0u);
}
INLINE uint layer_of_radius(uint set) {
  return layer_of_cells(set) + (layer_kinds(set) & LAYERS_CELLS ? 1u : 0u);
}
INLINE uint layer_count(uint set) {
  return layer_of_radius(set) + (layer_kinds(set) & LAYERS_RADIUS ? 1u : 0u);
}

#endif

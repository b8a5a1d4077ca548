// Adding to the layers of a picture (shared/layers.h): whole numbers of 64 bits, as splats are, so
// that sums depend neither on order nor on how passes and pixels were split.
#ifndef PELLUCID_FILM_LAYERS_H
#define PELLUCID_FILM_LAYERS_H

#include "film/film.h"
#include "shared/layers.h"

#if INTG_LAYERS

/// The layers of one pixel.
typedef struct LayerSink {
  GLOBAL uint* words;  // [layers][3 channels][2 words]
  GLOBAL uint* diag;
  uint set;
  float scale;
  int first;  // what comes is of the first vertex that gathers photons
} LayerSink;

/// Of the pixel with this index in the tile.
INLINE LayerSink layer_sink(GLOBAL uint* layers, GLOBAL uint* diag, Launch launch, uint pixel) {
  LayerSink sink;
  sink.words = layers + (size_t)pixel * (layer_count(launch.layer_set) * LAYER_WORDS);
  sink.diag = diag;
  sink.set = launch.layer_set;
  sink.scale = launch.layer_scale;
  sink.first = 0;
  return sink;
}

/// Adds a whole number to a word of the layer.
INLINE void layer_put_count(LayerSink sink, uint layer, uint word, ulong count) {
  splat_word(sink.words + layer * LAYER_WORDS + word, sink.diag, count, DIAG_layer_saturated);
}

INLINE void layer_put_channel(LayerSink sink, GLOBAL uint* word, float value) {
  if (value == 0.0f) return;
  ulong steps = splat_steps(value, sink.scale, sink.diag, DIAG_layer_saturated);
  splat_word(word, sink.diag, steps, DIAG_layer_saturated);
}

INLINE void layer_put(LayerSink sink, uint layer, real3 value) {
  if (!is_finite(value.x) || !is_finite(value.y) || !is_finite(value.z) || value.x < 0.0f ||
      value.y < 0.0f || value.z < 0.0f) {
    diag_add(sink.diag, DIAG_layer_dropped);
    return;
  }
  GLOBAL uint* word = sink.words + layer * LAYER_WORDS;
  layer_put_channel(sink, word, value.x);
  layer_put_channel(sink, word + 2, value.y);
  layer_put_channel(sink, word + 4, value.z);
}

/// Adds what strategy `s` found as a path of `depth` segments.
INLINE void layer_add(LayerSink sink, real3 value, real weight, uint s, uint depth) {
  uint kinds = layer_kinds(sink.set);
  if (kinds & LAYERS_LENGTH) layer_put(sink, layer_of_length(sink.set, depth), value * weight);
  if (!(kinds & LAYERS_TECH)) return;
  layer_put(sink, layer_of_weighted(sink.set, s, depth), value * weight);
  if (depth <= layer_longest(sink.set))
    layer_put(sink, layer_of_unweighted(sink.set, s, depth), value);
}

/// Counts a photon within the radius of the first vertex that gathers.
INLINE void layer_photon(LayerSink sink) {
  if (sink.first && (layer_kinds(sink.set) & LAYERS_PHOTONS))
    layer_put_count(sink, layer_of_photons(sink.set), 0u, 1ul);
}

/// Adds what a merge at eye vertex k found as a path of `depth` segments.
INLINE void layer_merge(LayerSink sink, real3 value, real weight, uint k, uint depth) {
  uint kinds = layer_kinds(sink.set);
  if (kinds & LAYERS_LENGTH) layer_put(sink, layer_of_length(sink.set, depth), value * weight);
  if (!(kinds & LAYERS_MERGE)) return;
  layer_put(sink, layer_of_merge(sink.set, k), value * weight);
  if (k <= layer_longest(sink.set)) layer_put(sink, layer_of_merge_unweighted(sink.set, k), value);
}

/// The same for pixel (x, y) of the whole picture, from any work-item; nothing outside the tile.
INLINE void layer_splat(GLOBAL uint* layers, GLOBAL uint* diag, Launch launch, int x, int y,
                        real3 value, real weight, uint s, uint depth) {
  if (!film_in_tile(launch, x, y)) return;
  layer_add(layer_sink(layers, diag, launch, film_pixel(launch, x, y)), value, weight, s, depth);
}

/// Counts a light vertex that the camera sees in pixel (x, y) of the whole picture.
INLINE void layer_vertex(GLOBAL uint* layers, GLOBAL uint* diag, Launch launch, int x, int y) {
  if (!(layer_kinds(launch.layer_set) & LAYERS_VERTICES) || !film_in_tile(launch, x, y)) return;
  LayerSink sink = layer_sink(layers, diag, launch, film_pixel(launch, x, y));
  layer_put_count(sink, layer_of_vertices(sink.set), 0u, 1ul);
}

/// Paints the pixel by the cell that its first gathering vertex lies in.
INLINE void layer_cell(LayerSink sink, uint photons, uint bucket, uint parity) {
  uint layer = layer_of_cells(sink.set);
  layer_put_count(sink, layer, LAYER_CELL_PHOTONS, photons);
  layer_put_count(sink, layer, LAYER_CELL_BUCKET, bucket);
  layer_put_count(sink, layer, LAYER_CELL_PARITY, parity);
}

/// Adds the radius of merging at that vertex, in pixels.
INLINE void layer_radius(LayerSink sink, float pixels) {
  if (!(layer_kinds(sink.set) & LAYERS_RADIUS)) return;
  ulong steps = splat_steps(pixels, LAYER_RADIUS_STEPS, sink.diag, DIAG_layer_saturated);
  layer_put_count(sink, layer_of_radius(sink.set), 0u, steps);
}

#endif
#endif

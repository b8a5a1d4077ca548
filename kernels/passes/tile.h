// From a work-item over a tile to its pixel of the whole picture and this iteration's sample of it.
#ifndef PELLUCID_PASSES_TILE_H
#define PELLUCID_PASSES_TILE_H

#include "camera/camera.h"
#include "camera/filter.h"

typedef struct TileSample {
  uint column, row;  // of the whole picture
  Rng rng;           // its path is the pixel of the whole picture: a crop has the same numbers
  Ray ray;           // from the camera through the sample's film position
} TileSample;

/// `index` counts the tile's pixels row by row.
INLINE TileSample tile_sample(Launch launch, Camera camera, GLOBAL const float* filter_table,
                              uint index) {
  TileSample s;
  s.column = launch.tile_x + index % launch.tile_width;
  s.row = launch.tile_y + index / launch.tile_width;
  s.rng.path = s.row * launch.width + s.column;
  s.rng.iteration = launch.iteration;
  s.rng.seed = launch.seed;
  FilmPosition at = film_position(filter_table, s.column, s.row, rng4(s.rng, DIM_PIXEL));
  s.ray = camera_ray(camera, at.x, at.y);
  return s;
}

#endif

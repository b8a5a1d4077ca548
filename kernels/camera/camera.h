// Pinhole camera: rays through pixels. Image x grows to the right, y downwards.
#ifndef PELLUCID_CAMERA_CAMERA_H
#define PELLUCID_CAMERA_CAMERA_H

#include "geom/ray.h"

/// Ray through film position (x, y) in pixels from the top left.
INLINE Ray camera_ray(Camera camera, real x, real y) {
  real3 d = load3(camera.corner) + load3(camera.dx) * x + load3(camera.dy) * y;
  return make_ray(load3(camera.origin), normalize3(d), REAL_MAX);
}

#endif

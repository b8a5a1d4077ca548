// Pinhole camera: rays through pixels. Image x grows to the right, y downwards.
#ifndef PELLUCID_CAMERA_CAMERA_H
#define PELLUCID_CAMERA_CAMERA_H

#include "geom/ray.h"

/// Ray through film position (x, y) in pixels from the top left.
INLINE Ray camera_ray(Camera camera, real x, real y) {
  Ray ray;
  ray.o = load3(camera.origin);
  ray.d = normalize3(load3(camera.corner) + load3(camera.dx) * x + load3(camera.dy) * y);
  ray.t_max = REAL_MAX;
  return ray;
}

#endif

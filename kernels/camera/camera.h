// Pinhole camera: rays through pixels, and points projected onto them. Image x grows to the right,
// y downwards.
#ifndef PELLUCID_CAMERA_CAMERA_H
#define PELLUCID_CAMERA_CAMERA_H

#include "camera/filter.h"
#include "geom/ray.h"

/// Ray through film position (x, y) in pixels from the top left.
INLINE Ray camera_ray(Camera camera, real x, real y) {
  real3 d = load3(camera.corner) + load3(camera.dx) * x + load3(camera.dy) * y;
  return make_ray(load3(camera.origin), normalize3(d), REAL_MAX);
}

/// Density [1/sr] of the unit direction d per pixel of area: D^2 / cos^3 with the film at distance
/// D pixels [Georgiev12 eq. 25]. It is the camera's importance, too: pixels average over their
/// area.
INLINE real camera_pdf_w(Camera camera, real3 d) {
  real cos_d = dot3(d, load3(camera.forward)), distance = (real)camera.forward.w;
  return distance * distance / (cos_d * cos_d * cos_d);
}

/// Where a point of the world lies on the film, in pixels; 0 if it is behind the camera.
INLINE int camera_project(Camera camera, real3 p, PRIVATE FilmPosition* at) {
  real3 v = p - load3(camera.origin);
  real depth = dot3(v, load3(camera.forward)), distance = (real)camera.forward.w;
  if (!(depth > REAL(0.0))) return 0;
  real3 from_corner = v * (REAL(1.0) / depth) - load3(camera.corner);
  // dx and dy are 1 / distance long.
  at->x = dot3(from_corner, load3(camera.dx)) * distance * distance;
  at->y = dot3(from_corner, load3(camera.dy)) * distance * distance;
  return 1;
}

#endif

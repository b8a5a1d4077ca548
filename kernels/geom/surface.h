// What a hit means: position with its error bound, normals, texture coordinates, material and
// light.
#ifndef PELLUCID_GEOM_SURFACE_H
#define PELLUCID_GEOM_SURFACE_H

#include "core/math.h"
#include "geom/bvh_traverse.h"
#include "geom/triangle_point.h"

typedef struct Surface {
  real3 p;      // world; on the surface up to `offset`
  real3 ng;     // unit geometric normal, front side
  real3 ns;     // unit shading normal, unflipped
  real offset;  // distance along ng that surely clears the rounding error of p
  uint material;
  uint flags;  // SHAPE_*
  uint light;  // index of the light this primitive is, or NONE
#if FEAT_TEXTURE
  real u, v;  // texture coordinates; 0 unless SHAPE_TEXTURED
#endif
} Surface;

/// Sphere: point and error from its outward normal.
INLINE void sphere_point(F4 center_radius, real3 n, PRIVATE Surface* s) {
  real3 c = load3(center_radius);
  real r = (real)center_radius.w;
  s->p = c + n * r;
  s->ng = s->ns = n;
  real3 bound = abs3(c) + abs3(n) * r + r;  // n itself is off by a few roundoffs of 1, hence + r
  s->offset = (real)(POINT_ERROR_ULPS * UNIT_ROUNDOFF) * dot3(abs3(n), bound);
}

/// Disk: `p` pulled onto the plane.
INLINE void disk_point(Quadric q, real3 p, PRIVATE Surface* s) {
  real3 c = load3(q.center_radius);
  s->ng = s->ns = load3(q.normal);
  s->p = p - s->ng * dot3(p - c, s->ng);
  real3 bound = abs3(c) + abs3(s->p) + (real)q.center_radius.w;
  s->offset = (real)(POINT_ERROR_ULPS * UNIT_ROUNDOFF) * dot3(abs3(s->ng), bound);
}

#if FEAT_TEXTURE
/// Texture coordinates of a point already known. Sphere: longitude grows eastwards from 0 at the
/// back to 1, latitude from 0 at the south pole to 1. Disk: the square around it.
INLINE void quadric_uv(Quadric q, PRIVATE Surface* s) {
  real3 n = load3(q.normal), t = load3(q.tangent);
  real3 b = cross3(n, t) * (real)q.tangent.w;
  if (q.kind == QUADRIC_SPHERE) {
    real east = dot3(s->ng, b), front = dot3(s->ng, t);
    s->u = REAL(0.5) + atan2_turns(east, front);
    // From the pole by its tangent: the arc sine of a height knows only half the digits there.
    s->v = REAL(1.0) - REAL(2.0) * atan2_turns(r_sqrt(sqr(east) + sqr(front)), dot3(s->ng, n));
  } else {
    real3 d = s->p - load3(q.center_radius);
    real half_inv = REAL(0.5) / (real)q.center_radius.w;
    s->u = REAL(0.5) + dot3(d, t) * half_inv;
    s->v = REAL(0.5) + dot3(d, b) * half_inv;
  }
}
#endif

/// Triangle: point, normals and texture coordinates from barycentrics.
INLINE void triangle_point(PRIVATE const SceneData* scene, Triangle tri, real b1, real b2,
                           PRIVATE Surface* s) {
  TrianglePoint at =
      point_of_triangle(load3(scene->positions[tri.v0]), load3(scene->positions[tri.v1]),
                        load3(scene->positions[tri.v2]), b1, b2);
  s->p = at.p;
  s->ng = s->ns = at.ng;
  s->offset = at.offset;
#if FEAT_TEXTURE || FEAT_SMOOTH_NORMALS
  real b0 = REAL(1.0) - b1 - b2;
#endif
#if FEAT_TEXTURE
  if (s->flags & SHAPE_TEXTURED) {
    GLOBAL const float* uv0 = scene->uvs + (size_t)2 * tri.v0;
    GLOBAL const float* uv1 = scene->uvs + (size_t)2 * tri.v1;
    GLOBAL const float* uv2 = scene->uvs + (size_t)2 * tri.v2;
    s->u = (real)uv0[0] * b0 + (real)uv1[0] * b1 + (real)uv2[0] * b2;
    s->v = (real)uv0[1] * b0 + (real)uv1[1] * b1 + (real)uv2[1] * b2;
  }
#endif
#if FEAT_SMOOTH_NORMALS
  if (s->flags & SHAPE_SMOOTH) {
    real3 n = load3(scene->normals[tri.v0]) * b0 + load3(scene->normals[tri.v1]) * b1 +
              load3(scene->normals[tri.v2]) * b2;
    real len2 = dot3(n, n);
    if (len2 > REAL(0.0)) s->ns = n * (REAL(1.0) / r_sqrt(len2));
  }
#endif
}

/// Fills shape, material and light of primitive `prim`; returns its shape index's record.
INLINE void surface_shape(PRIVATE const SceneData* scene, uint shape_index, uint prim,
                          PRIVATE Surface* s) {
  Shape shape = scene->shapes[shape_index];
  s->material = shape.material;
  s->flags = shape.flags;
#if FEAT_TEXTURE
  s->u = s->v = REAL(0.0);
#endif
  s->light = shape.first_light == NONE ? NONE : shape.first_light + (prim - shape.first_prim);
}

/// The surface at a hit of `ray` on a quadric.
INLINE Surface quadric_surface(PRIVATE const SceneData* scene, Ray ray, Hit hit) {
  Surface s;
  Quadric q = scene->quadrics[hit.prim - scene->info.triangle_count];
  surface_shape(scene, q.shape, hit.prim, &s);
  real3 p = ray.o + ray.d * hit.t;
  if (q.kind == QUADRIC_SPHERE) {
    sphere_point(q.center_radius, normalize3(p - load3(q.center_radius)), &s);
  } else {
    disk_point(q, p, &s);
  }
#if FEAT_TEXTURE
  if (s.flags & SHAPE_TEXTURED) quadric_uv(q, &s);
#endif
  return s;
}

/// The surface at a hit of `ray` (hit.prim != NONE).
INLINE Surface surface_at(PRIVATE const SceneData* scene, Ray ray, Hit hit) {
#if FEAT_SPHERES || FEAT_DISKS
#if FEAT_TRIANGLES
  if (hit.prim >= scene->info.triangle_count)
#endif
    return quadric_surface(scene, ray, hit);
#endif
#if FEAT_TRIANGLES || !(FEAT_SPHERES || FEAT_DISKS)
  Surface s;
  Triangle tri = scene->triangles[hit.prim];
  surface_shape(scene, tri.shape, hit.prim, &s);
  triangle_point(scene, tri, hit.b1, hit.b2, &s);
  return s;
#endif
}

#endif

// General connections: an eye path's end vertex joined to a light path's (s >= 2, t >= 2).
#ifndef PELLUCID_TRANSPORT_CONNECT_H
#define PELLUCID_TRANSPORT_CONNECT_H

#include "transport/mis.h"
#include "transport/stored_vertex.h"
#include "transport/walk.h"

/// What two vertices bring along the edge between them.
typedef struct Connection {
  real3 value;  // visibility still to be seen
  real weight;
  Ray ray;  // from the eye's vertex, for visibility
} Connection;

/// 0 where nothing passes.
INLINE int connect_vertices(PRIVATE const SceneData* scene, Launch launch,
                            PRIVATE const EndVertex* eye, PRIVATE const EndVertex* light,
                            PRIVATE Connection* link) {
  // Vertices are packed: what grazed a surface may come back from behind it.
  if (eye->v.black || light->v.black) return 0;
  real3 d = light->v.surface.p - eye->v.surface.p;
  real d2 = dot3(d, d);
  if (!(d2 > REAL(0.0))) return 0;
  real3 w = d * (REAL(1.0) / r_sqrt(d2));
  BsdfEval e = vertex_eval(scene, &eye->v, w);
  if (is_black(e.f)) return 0;
  BsdfEval l = vertex_eval(scene, &light->v, -w);
  if (is_black(l.f)) return 0;
  link->value = eye->beta * e.f * l.f * light->beta * (REAL(1.0) / d2);
  real survive_e = (real)eye->v.material.survive, survive_l = (real)light->v.material.survive;
  real reverse_e = vertex_pdf_reverse(scene, &eye->v, w) * survive_e;
  real reverse_l = vertex_pdf_reverse(scene, &light->v, -w) * survive_l;
  real cos_g_eye = r_abs(dot3(eye->v.surface.ng, w));
  real cos_g_light = r_abs(dot3(light->v.surface.ng, w));
  Partials from_light = light->partials;
#if INTG_MERGE
  from_light.trust = merge_trust(launch, 0, light->depth == 1u);
#endif
  real weight = partial_weight(
      launch.mis,
      partials_end(launch, from_light, e.pdf_w * survive_e * cos_g_light / d2, reverse_l),
      partials_end(launch, eye->partials, l.pdf_w * survive_l * cos_g_eye / d2, reverse_e));
  link->weight = mis_counted(scene, weight);
  real3 target = spawn_origin(light->v.surface.p, light->v.surface.ng, light->v.surface.offset, -w);
  return shadow_ray(&eye->v.surface, w, target, &link->ray);
}

#endif

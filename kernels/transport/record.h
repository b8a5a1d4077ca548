// The record of a replay: what happens on a path, written down as PathEvents. Work-items of one
// path write in order; without INTG_RECORD nothing is written, and calls are no code.
#ifndef PELLUCID_TRANSPORT_RECORD_H
#define PELLUCID_TRANSPORT_RECORD_H

#include "transport/partials.h"
#include "transport/vertex.h"

#if INTG_RECORD
INLINE F4 record_row(real3 v, real w) {
  return (F4)((float)v.x, (float)v.y, (float)v.z, (float)w);
}

/// An event of the work-item's path after `depth` segments.
INLINE PathEvent record_event(PRIVATE const SceneData* scene, uint kind, uint depth) {
  PathEvent e;
  e.kind = kind;
  e.path = scene->recorder.path;
  e.on_light = scene->recorder.on_light;
  e.depth = depth;
  e.partner = NONE;
  e.s = e.t = 0u;
  e.material = NONE;
  e.p = e.d = e.value = e.brought = (F4)(0.0f);
  return e;
}

INLINE void record_put(PRIVATE const SceneData* scene, PathEvent e) {
  if (!scene->recorder.on) return;
  uint place = atomic_inc(scene->recorder.count);
  if (place < scene->recorder.capacity) scene->recorder.events[place] = e;
}

/// Part of a pixel's sample: radiance `value`, of which `weight` counts.
INLINE void record_brought(PRIVATE const SceneData* scene, PathEvent e, real3 value, real weight,
                           real3 brought) {
  e.p.w = (float)weight;
  e.value.x = (float)value.x;
  e.value.y = (float)value.y;
  e.value.z = (float)value.z;
  e.brought = record_row(brought, 0.0f);
  record_put(scene, e);
}
#endif

/// The path starts along `ray`, drawn with density `pdf`: from the camera [1/sr], or
/// EmitSample.pdf.
INLINE void record_start(PRIVATE const SceneData* scene, Ray ray, real pdf, real3 beta) {
#if INTG_RECORD
  if (!scene->recorder.walk) return;
  PathEvent e = record_event(scene, EVENT_START, 0u);
  e.p = record_row(ray.o, 0.0f);
  e.d = record_row(ray.d, pdf);
  e.value = record_row(beta, 0.0f);
  record_put(scene, e);
#endif
}

/// It has come to the vertex with throughput `beta`.
INLINE void record_vertex(PRIVATE const SceneData* scene, uint depth, PRIVATE const Vertex* v,
                          real3 beta, real dVCM, real dVC) {
#if INTG_RECORD
  if (!scene->recorder.walk) return;
  PathEvent e = record_event(scene, EVENT_VERTEX, depth);
  e.material = v->surface.material;
  e.p = record_row(v->surface.p, 0.0f);
  e.d = record_row(v->surface.ng, 0.0f);
  e.value = record_row(beta, 0.0f);
  e.brought = (F4)((float)dVCM, (float)dVC, 0.0f, 0.0f);
  record_put(scene, e);
#endif
}

/// It goes on along `ray`; `pdf_w` includes survival and is 0 for delta lobes.
INLINE void record_scatter(PRIVATE const SceneData* scene, uint depth, Ray ray, real pdf_w,
                           real3 beta) {
#if INTG_RECORD
  if (!scene->recorder.walk) return;
  PathEvent e = record_event(scene, EVENT_SCATTER, depth);
  e.p = record_row(ray.o, 0.0f);
  e.d = record_row(ray.d, pdf_w);
  e.value = record_row(beta, 0.0f);
  record_put(scene, e);
#endif
}

#endif

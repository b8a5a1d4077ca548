// Vertices of sub-paths in memory, from one pass to the next: whole, or in half the bytes.
#ifndef PELLUCID_TRANSPORT_STORED_VERTEX_H
#define PELLUCID_TRANSPORT_STORED_VERTEX_H

#include "core/codes.h"
#include "transport/partials.h"
#include "transport/vertex.h"
#include "transport/vertex_format.h"

/// Where a sub-path puts its vertices.
typedef struct VertexStore {
  GLOBAL StoredVertex* vertices;
  GLOBAL uint* taken;  // slots asked for so far, by all work-items
  uint capacity;       // slots there are: what comes later is counted and not written
  uint last, count;    // of this sub-path: slot of its last vertex, and their number
} VertexStore;

INLINE VertexStore vertex_store_at(GLOBAL void* vertices, GLOBAL uint* taken, uint capacity) {
  VertexStore store;
  store.vertices = (GLOBAL StoredVertex*)vertices;
  store.taken = taken;
  store.capacity = capacity;
  store.last = NONE;
  store.count = 0u;
  return store;
}

/// A vertex as it comes back from memory.
typedef struct EndVertex {
  Vertex v;
  real3 beta;
  Partials partials;
  uint depth;
} EndVertex;

INLINE F4 to_f4(real3 v, real w) {
  F4 f;
  f.x = (float)v.x;
  f.y = (float)v.y;
  f.z = (float)v.z;
  f.w = (float)w;
  return f;
}

/// In the flags of a stored vertex, where nobody asks for emission: all scatterings of its walk
/// from the camera were by delta lobes.
#define VERTEX_FIRST SHAPE_EMIT_FRONT

INLINE uint stored_flags(uint flags, Partials q) {
#if INTG_MERGE
  flags = (flags & ~VERTEX_FIRST) | (q.trust == REAL(1.0) ? VERTEX_FIRST : 0u);
#endif
  return flags;
}

/// Partials of an eye's vertex that comes back with these flags: only Launch knows what others are
/// worth.
INLINE void restore_trust(uint flags, PRIVATE Partials* q) {
#if INTG_MERGE
  q->trust = flags & VERTEX_FIRST ? REAL(1.0) : REAL(0.0);
#endif
}

#if INTG_COMPACT
INLINE StoredVertex vertex_pack(PRIVATE const Vertex* v, real3 beta, Partials q, uint depth) {
  StoredVertex s;
  s.x = (float)v->surface.p.x;
  s.y = (float)v->surface.p.y;
  s.z = (float)v->surface.p.z;
  s.material = v->surface.material | (stored_flags(v->surface.flags, q) << COMPACT_MATERIAL_BITS) |
               (float_exponent_above((float)v->surface.offset) << 24);
  s.ng = octahedral_pack(v->surface.ng);
  s.ns = octahedral_pack(v->surface.ns);
  s.wo = octahedral_pack(v->wo);
  s.beta = rgbe_pack(beta);
  s.dVCM = float24_pack((float)q.dVCM) | (depth & 0xffu);
  s.dVC = float24_pack((float)partials_dVC(q)) | (depth >> 8);
#if FEAT_TEXTURE
  s.uv = half_pack((float)v->surface.u) | (half_pack((float)v->surface.v) << 16);
#else
  s.uv = 0u;
#endif
  return s;
}

INLINE EndVertex vertex_unpack(PRIVATE const SceneData* scene, StoredVertex s, int importance) {
  EndVertex e;
  Surface surface;
  surface.p = REAL3(s.x, s.y, s.z);
  surface.ng = octahedral_unpack(s.ng);
  surface.ns = octahedral_unpack(s.ns);
  surface.offset = (real)float_from_bits((s.material >> 24) << 23);
  surface.material = s.material & (COMPACT_MATERIALS - 1u);
  surface.flags = (s.material >> COMPACT_MATERIAL_BITS) & 0x1fu;
  surface.light = NONE;
#if FEAT_TEXTURE
  surface.u = (real)half_unpack(s.uv & 0xffffu);
  surface.v = (real)half_unpack(s.uv >> 16);
#endif
  e.v = vertex_at(scene, surface, octahedral_unpack(s.wo), importance);
  e.beta = rgbe_unpack(s.beta);
  e.partials = partials_start((real)float_from_bits(s.dVCM & 0xffffff00u),
                              (real)float_from_bits(s.dVC & 0xffffff00u));
  restore_trust(surface.flags, &e.partials);
  e.depth = (s.dVCM & 0xffu) | ((s.dVC & 0xffu) << 8);
  return e;
}
#else
INLINE StoredVertex vertex_pack(PRIVATE const Vertex* v, real3 beta, Partials q, uint depth) {
  StoredVertex s;
  real tex_u = REAL(0.0), tex_v = REAL(0.0);
#if FEAT_TEXTURE
  tex_u = v->surface.u;
  tex_v = v->surface.v;
#endif
  s.p_offset = to_f4(v->surface.p, v->surface.offset);
  s.ng_u = to_f4(v->surface.ng, tex_u);
  s.ns_v = to_f4(v->surface.ns, tex_v);
  s.wo_dVCM = to_f4(v->wo, q.dVCM);
  s.beta_dVC = to_f4(beta, partials_dVC(q));
  s.material = v->surface.material;
  s.flags = stored_flags(v->surface.flags, q);
  s.depth = depth;
  return s;
}

INLINE EndVertex vertex_unpack(PRIVATE const SceneData* scene, StoredVertex s, int importance) {
  EndVertex e;
  Surface surface;
  surface.p = load3(s.p_offset);
  surface.offset = (real)s.p_offset.w;
  surface.ng = load3(s.ng_u);
  surface.ns = load3(s.ns_v);
  surface.material = s.material;
  surface.flags = s.flags;
  surface.light = NONE;
#if FEAT_TEXTURE
  surface.u = (real)s.ng_u.w;
  surface.v = (real)s.ns_v.w;
#endif
  e.v = vertex_at(scene, surface, load3(s.wo_dVCM), importance);
  e.beta = load3(s.beta_dVC);
  e.partials = partials_start((real)s.wo_dVCM.w, (real)s.beta_dVC.w);
  restore_trust(surface.flags, &e.partials);
  e.depth = s.depth;
  return e;
}
#endif

/// Segments of its sub-path up to a vertex in memory.
INLINE uint stored_depth(GLOBAL const StoredVertex* s) {
#if INTG_COMPACT
  return (s->dVCM & 0xffu) | ((s->dVC & 0xffu) << 8);
#else
  return s->depth;
#endif
}

/// Where a vertex in memory is.
INLINE real3 stored_position(GLOBAL const StoredVertex* s) {
#if INTG_COMPACT
  return REAL3(s->x, s->y, s->z);
#else
  return load3(s->p_offset);
#endif
}

#if INTG_MERGE
/// Whether a light vertex is merged: what comes straight from its source is brought by light
/// samples where there are any.
INLINE int stored_merges(GLOBAL const StoredVertex* s) {
  return !INTG_NEE || stored_depth(s) > 1u;
}

/// What merging needs of a light vertex in memory, beside its position.
INLINE Photon photon_of(GLOBAL const StoredVertex* s) {
  Photon photon;
#if INTG_COMPACT
  photon.wi_dVCM = to_f4(octahedral_unpack(s->wo), (real)float_from_bits(s->dVCM & 0xffffff00u));
  photon.beta_dVC = to_f4(rgbe_unpack(s->beta), (real)float_from_bits(s->dVC & 0xffffff00u));
  real3 ng = octahedral_unpack(s->ng);
#else
  photon.wi_dVCM = s->wo_dVCM;
  photon.beta_dVC = s->beta_dVC;
  real3 ng = load3(s->ng_u);
#endif
  photon.ng_x = (float)ng.x;
  photon.ng_y = (float)ng.y;
  photon.ng_z = (float)ng.z;
  photon.depth = stored_depth(s);
  return photon;
}
#endif

/// Appends a vertex to the sub-path. Which slot it gets depends on the order of work; which place
/// in its path does not.
INLINE void vertex_store(PRIVATE VertexStore* store, PRIVATE const Vertex* v, real3 beta,
                         Partials partials, uint depth) {
#if PELLUCID_DEVICE
  uint slot = atomic_inc(store->taken);
#else
  uint slot = (*store->taken)++;
#endif
  if (slot >= store->capacity) return;
  StoredVertex s = vertex_pack(v, beta, partials, depth);
  s.before = store->last;
  store->vertices[slot] = s;
  store->last = slot;
  ++store->count;
}

#endif

// The running quantities that give every strategy's weight in O(1) [Georgiev12 "Implementing Vertex
// Connection and Merging"].
//
// Quantities are ratios of densities and never squared: under the power heuristic sums of squares
// are kept as their root. So both heuristics have the same range of numbers (numerics 7).
#ifndef PELLUCID_TRANSPORT_PARTIALS_H
#define PELLUCID_TRANSPORT_PARTIALS_H

#include "core/real.h"
#include "shared/layout.h"

/// Every strategy is weighed against all others: the walks carry what that takes. `sppm` merges
/// where it goes no further, so that its strategies never meet.
#define INTG_PARTIALS (INTG_CONNECT || (INTG_MERGE && !INTG_NEE))

/// Merging leaves light straight from its source to light samples.
#define INTG_DIRECT_APART (INTG_MERGE && INTG_NEE)

/// What a sub-path knows of the strategies that would have drawn its vertices from the other end.
/// dVC is a sum over all its vertices, so it may leave the range of float on the way and come back.
/// Merges need no third quantity: where connections are weighed against them, too, [Georgiev12]'s
/// dVM is dVC / Launch.mis_vm from the start on: their recursions turn into each other.
typedef struct Partials {
  real dVCM;
  real dVC_scaled;  // dVC over 2^(64 scale)
  uint scale;
#if INTG_MERGE
  real trust;  // share of Launch.mis_vm that a merge at this side's last vertex weighs
#endif
#if INTG_DIRECT_APART
  real dVC_direct;  // dVC_scaled without a merge at the vertex before: a light here hides it
#endif
} Partials;

#define PARTIALS_SCALE REAL(18446744073709551616.0)         /* 2^64 */
#define PARTIALS_SCALE_INV REAL(5.42101086242752217004e-20) /* 2^-64 */

INLINE Partials partials_start(real dVCM, real dVC) {
  Partials q;
  q.dVCM = dVCM;
  q.dVC_scaled = dVC;
  q.scale = 0u;
#if INTG_MERGE
  q.trust = REAL(0.0);
#endif
#if INTG_DIRECT_APART
  q.dVC_direct = dVC;
#endif
  return q;
}

#if INTG_MERGE
/// Share of its density that a merge weighs: full where delta scatterings alone have led from the
/// camera; less at other vertices; nothing for light that comes straight from its source, which
/// light samples bring with less noise.
INLINE real merge_trust(Launch launch, int first, int direct) {
#if INTG_NEE
  if (direct) return REAL(0.0);
#endif
  return first ? REAL(1.0) : (real)launch.mis_deep;
}
#endif

/// Of a walk from the camera, whose direction has density `pdf_camera` [1/sr].
INLINE Partials partials_from_camera(Launch launch, real pdf_camera) {
  Partials q = partials_start((real)launch.light_paths / pdf_camera, REAL(0.0));
#if INTG_MERGE
  q.trust = REAL(1.0);
#endif
  return q;
}

/// dVC at the end of a sub-path, cut at the largest number: what is left of a strategy against it
/// is nothing.
INLINE real partials_unscaled(Partials q, real scaled) {
  if (q.scale == 0u) return scaled;
  return q.scale == 1u ? r_min(scaled * PARTIALS_SCALE, REAL_MAX) : REAL_MAX;
}
INLINE real partials_dVC(Partials q) {
  return partials_unscaled(q, q.dVC_scaled);
}
/// The same where the walk has come upon a light: the vertex before is not merged with its light.
INLINE real partials_dVC_emission(Partials q) {
#if INTG_DIRECT_APART
  return partials_unscaled(q, q.dVC_direct);
#else
  return partials_dVC(q);
#endif
}

/// Keeps dVC within the range of float. At scale 0 it may well vanish: it will be added to dVCM.
INLINE void partials_rescale(PRIVATE Partials* q) {
  real factor = REAL(1.0);
  if (q->dVC_scaled > PARTIALS_SCALE) {
    factor = PARTIALS_SCALE_INV;
    ++q->scale;
  } else if (q->scale > 0u && q->dVC_scaled < REAL(1.0)) {
    factor = PARTIALS_SCALE;
    --q->scale;
  }
  q->dVC_scaled = r_min(q->dVC_scaled, REAL_MAX) * factor;
#if INTG_DIRECT_APART
  q->dVC_direct = r_min(q->dVC_direct, REAL_MAX) * factor;
#endif
}

/// a + b, or under the power heuristic sqrt(a^2 + b^2), for a, b >= 0. Cut at the largest number:
/// an infinity would make NaN of the next density that is 0.
INLINE real partial_sum(uint heuristic, real a, real b) {
  real high = r_max(a, b), low = r_min(a, b);
  if (heuristic != MIS_POWER || high == REAL(0.0)) return r_min(a + b, REAL_MAX);
  real r = low / high;
  return r_min(high * r_sqrt(REAL(1.0) + r * r), REAL_MAX);
}

/// Weight of a strategy against the others on the light's and on the eye's side, each the
/// partial_sum of their densities over its own.
INLINE real partial_weight(uint heuristic, real light, real eye) {
  if (heuristic == MIS_POWER) {
    light = light * light;
    eye = eye * eye;
  }
  return REAL(1.0) / (REAL(1.0) + light + eye);
}

#if INTG_MERGE
/// What a merge at the last vertex weighs over a connection to it.
INLINE real merge_density(Launch launch, Partials q) {
  return (real)launch.mis_vm * q.trust;
}
#endif

/// Of the strategies on one side, those that end at its last vertex: a connection to it, a merge.
INLINE real partials_here(Launch launch, Partials q) {
#if INTG_CONNECT && INTG_MERGE
  return partial_sum(launch.mis, q.dVCM, merge_density(launch, q));
#elif INTG_MERGE
  return merge_density(launch, q);
#else
  return q.dVCM;
#endif
}

/// The sub-path arrives over `distance2` at a surface under |cos| to its geometric normal.
INLINE void partials_arrive(PRIVATE Partials* q, real distance2, real cos_g) {
  real inv = r_min(REAL(1.0) / cos_g, REAL_MAX);
  q->dVCM = r_min(q->dVCM * distance2 * inv, REAL_MAX);
  q->dVC_scaled = r_min(q->dVC_scaled * inv, REAL_MAX);
}

/// It goes on by a lobe with densities `forward` and `reverse` [1/sr], survival included, leaving
/// under |cos| to the geometric normal.
INLINE void partials_scatter(Launch launch, PRIVATE Partials* q, real forward, real reverse,
                             real cos_g) {
  real inv = r_min(REAL(1.0) / forward, REAL_MAX);
  real before = q->dVC_scaled * reverse, here = partials_here(launch, *q);
  if (before == REAL(0.0)) q->scale = 0u;  // nothing is left of what has made it large
  real unit = q->scale == 0u ? REAL(1.0) : q->scale == 1u ? PARTIALS_SCALE_INV : REAL(0.0);
#if INTG_DIRECT_APART
  q->dVC_direct = partial_sum(launch.mis, before, q->dVCM * unit) * cos_g * inv;
#endif
  q->dVC_scaled = partial_sum(launch.mis, before, here * unit) * cos_g * inv;
  q->dVCM = r_min(inv, REAL_MAX);
  partials_rescale(q);
}

/// It goes on by a delta lobe: nothing connects here. `reverse` is the density of the way back over
/// that of the way there (BsdfSample.reverse).
INLINE void partials_scatter_delta(PRIVATE Partials* q, real reverse, real cos_g) {
  q->dVCM = REAL(0.0);
  q->dVC_scaled = q->dVC_scaled * cos_g * reverse;
#if INTG_DIRECT_APART
  q->dVC_direct = q->dVC_scaled;  // light that comes by way of this lobe may be merged before
#endif
  partials_rescale(q);
}

/// What the strategies on one side weigh at its end vertex: `pdf_a` [1/m^2] draws this vertex from
/// the other side, `reverse` [1/sr] from here the one before.
INLINE real partials_end(Launch launch, Partials q, real pdf_a, real reverse) {
  real before = partials_dVC(q) * reverse;
  return pdf_a * partial_sum(launch.mis, before, partials_here(launch, q));
}

#if INTG_MERGE
/// What they weigh where both sides merge in that vertex.
INLINE real partials_merge(Launch launch, Partials q, real reverse) {
  real sum = partials_dVC(q) * reverse;
#if INTG_CONNECT
  sum = partial_sum(launch.mis, sum, q.dVCM);
#endif
  return sum / merge_density(launch, q);
}
#endif

#endif

// The running quantities that give every strategy's weight in O(1) [Georgiev12 "Implementing Vertex
// Connection and Merging"], for connections alone.
//
// Quantities are ratios of densities and never squared: under the power heuristic sums of squares
// are kept as their root. So both heuristics have the same range of numbers (numerics 7).
#ifndef PELLUCID_TRANSPORT_PARTIALS_H
#define PELLUCID_TRANSPORT_PARTIALS_H

#include "core/real.h"
#include "shared/layout.h"

/// What a sub-path knows of the strategies that would have drawn its vertices from the other end.
typedef struct Partials {
  real dVCM, dVC;
} Partials;

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

/// The sub-path arrives over `distance2` at a surface under |cos| to its geometric normal.
INLINE void partials_arrive(PRIVATE Partials* q, real distance2, real cos_g) {
  real inv = REAL(1.0) / cos_g;
  q->dVCM = r_min(q->dVCM * distance2 * inv, REAL_MAX);
  q->dVC = r_min(q->dVC * inv, REAL_MAX);
}

/// It goes on by a lobe with densities `forward` and `reverse` [1/sr], survival included, leaving
/// under |cos| to the geometric normal.
INLINE void partials_scatter(uint heuristic, PRIVATE Partials* q, real forward, real reverse,
                             real cos_g) {
  real inv = REAL(1.0) / forward;
  real before = partial_sum(heuristic, q->dVC * reverse, q->dVCM);
  q->dVC = r_min(before * cos_g * inv, REAL_MAX);
  q->dVCM = r_min(inv, REAL_MAX);
}

/// It goes on by a delta lobe: nothing connects here. `reverse` is the density of the way back over
/// that of the way there (BsdfSample.reverse).
INLINE void partials_scatter_delta(PRIVATE Partials* q, real reverse, real cos_g) {
  q->dVCM = REAL(0.0);
  q->dVC = r_min(q->dVC * cos_g * reverse, REAL_MAX);
}

/// What the strategies on one side weigh at its end vertex: `pdf_a` [1/m^2] draws this vertex from
/// the other side, `reverse` [1/sr] from here the one before.
INLINE real partials_end(uint heuristic, Partials q, real pdf_a, real reverse) {
  return pdf_a * partial_sum(heuristic, q.dVC * reverse, q.dVCM);
}

#endif

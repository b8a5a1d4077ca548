// Weights for combining two ways to sample one path [Veach97 ch. 9], written in ratios so that
// large and tiny densities neither overflow nor vanish (numerics 7).
#ifndef PELLUCID_TRANSPORT_MIS_H
#define PELLUCID_TRANSPORT_MIS_H

#include "core/real.h"
#include "geom/scene_data.h"

/// Weight of the strategy with density a > 0 against another with density b >= 0 (one sample each).
/// Under MIS_MAX a tie goes to the strategy that says so with `wins_tie`.
INLINE real mis_weight(uint heuristic, real a, real b, int wins_tie) {
  if (heuristic == MIS_MAX) return (a > b || (a == b && wins_tie)) ? REAL(1.0) : REAL(0.0);
  real r = a >= b ? b / a : a / b;
  if (heuristic == MIS_POWER) r = r * r;
  return (a >= b ? REAL(1.0) : r) / (REAL(1.0) + r);
}

/// Counts a weight that is none; both forms of weights stay within [0, 1] to the last bit as long
/// as densities are not negative.
INLINE real mis_counted(PRIVATE const SceneData* scene, real weight) {
  if (!(weight >= REAL(0.0) && weight <= REAL(1.0))) diag_count(scene, DIAG_weight_outside);
  return weight;
}

#endif

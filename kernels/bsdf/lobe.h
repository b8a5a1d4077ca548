// What every lobe takes and gives. Local frame around the shading normal, flipped so that wo.z > 0;
// wi.z > 0 is reflection, wi.z < 0 transmission. All lobes are seen by both kinds of walk:
// `importance` says that the walk started at a light, where refraction does not scale by eta^2
// [Veach97 5.2].
#ifndef PELLUCID_BSDF_LOBE_H
#define PELLUCID_BSDF_LOBE_H

#include "core/warp.h"
#include "shared/layout.h"
#include "shared/limits.h"

typedef struct BsdfContext {
  real3 wo;        // unit, local, wo.z > 0
  real eta;        // dielectrics: index on the far side over index on the side of wo
  int importance;  // 1: walk from a light; 0: walk from the camera
} BsdfContext;

/// f(wo, wi) [1/sr] without the cosine, and the density [1/sr] with which sampling draws wi given
/// wo.
typedef struct BsdfEval {
  real3 f;
  real pdf_w;
} BsdfEval;

/// A drawn direction. weight = f |wi.z| / pdf_w, already cancelled; 0 where nothing is scattered.
typedef struct BsdfSample {
  real3 wi;  // unit, local
  real3 weight;
  real pdf_w;    // [1/sr]; 0 for a delta lobe
  real reverse;  // delta lobe: density of the way back over that of the way there, in solid angles:
                 // |dwi/dwo|, 1 unless refraction narrows or widens the beam
  int delta;     // wi is the only direction
} BsdfSample;

INLINE BsdfEval bsdf_eval_none(void) {
  BsdfEval e;
  e.f = REAL3(0.0f, 0.0f, 0.0f);
  e.pdf_w = REAL(0.0);
  return e;
}
INLINE BsdfSample bsdf_sample_none(void) {
  BsdfSample s;
  s.wi = REAL3(0.0f, 0.0f, 1.0f);
  s.weight = REAL3(0.0f, 0.0f, 0.0f);
  s.pdf_w = REAL(0.0);
  s.reverse = REAL(1.0);
  s.delta = 0;
  return s;
}

#endif

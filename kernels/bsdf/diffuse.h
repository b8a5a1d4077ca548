// Lambertian reflection: f = reflectance / pi.
#ifndef PELLUCID_BSDF_DIFFUSE_H
#define PELLUCID_BSDF_DIFFUSE_H

#include "bsdf/lobe.h"

INLINE BsdfEval diffuse_eval(Material m, real3 wi) {
  BsdfEval e = bsdf_eval_none();
  if (wi.z <= REAL(0.0)) return e;
  e.f = load3(m.reflectance) * INV_PI;
  e.pdf_w = wi.z * INV_PI;
  return e;
}

INLINE BsdfSample diffuse_sample(Material m, real u, real v) {
  BsdfSample s = bsdf_sample_none();
  s.wi = warp_cosine_hemisphere(u, v);
  s.pdf_w = s.wi.z * INV_PI;
  s.weight = load3(m.reflectance);
  return s;
}

#endif

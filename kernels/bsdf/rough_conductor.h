// Rough metal: single-scattering GGX with the exact conductor Fresnel term [Walter07; Heitz14].
#ifndef PELLUCID_BSDF_ROUGH_CONDUCTOR_H
#define PELLUCID_BSDF_ROUGH_CONDUCTOR_H

#include "bsdf/fresnel.h"
#include "bsdf/ggx.h"

INLINE BsdfEval rough_conductor_eval(Material m, real3 wo, real3 wi) {
  BsdfEval e = bsdf_eval_none();
  if (wi.z <= REAL(0.0)) return e;
  real alpha = (real)m.alpha;
  real3 h = normalize3(wo + wi);
  real so = ggx_s(wo, alpha), si = ggx_s(wi, alpha);
  real d = ggx_d(h, alpha);
  real common = d / (REAL(2.0) * wo.z);
  e.pdf_w = common / (REAL(1.0) + so);
  e.f = fresnel_conductor(r_min(dot3(wo, h), REAL(1.0)), load3(m.eta_specular), load3(m.k)) *
        (common / ((so + si) * wi.z));
  return e;
}

INLINE BsdfSample rough_conductor_sample(Material m, real3 wo, real u, real v) {
  BsdfSample s = bsdf_sample_none();
  real alpha = (real)m.alpha;
  real3 h = ggx_sample_visible(wo, alpha, u, v);
  s.wi = reflect_about(wo, h);
  if (s.wi.z <= REAL(0.0)) return bsdf_sample_none();
  real so = ggx_s(wo, alpha), si = ggx_s(s.wi, alpha);
  s.pdf_w = ggx_d(h, alpha) / (REAL(2.0) * wo.z * (REAL(1.0) + so));
  s.weight = fresnel_conductor(r_min(dot3(wo, h), REAL(1.0)), load3(m.eta_specular), load3(m.k)) *
             ((REAL(1.0) + so) / (so + si));
  return s;
}

#endif

// Rough metal: single-scattering GGX with the exact conductor Fresnel term [Walter07; Heitz14].
#ifndef PELLUCID_BSDF_ROUGH_CONDUCTOR_H
#define PELLUCID_BSDF_ROUGH_CONDUCTOR_H

#include "bsdf/fresnel.h"
#include "bsdf/ggx.h"

INLINE BsdfEval rough_conductor_eval(Material m, real3 wo, real3 wi) {
  BsdfEval e = bsdf_eval_none();
  if (wi.z <= REAL(0.0)) return e;
  GgxReflection r = ggx_reflection(wo, wi, (real)m.alpha);
  e.pdf_w = r.pdf_w;
  e.f = fresnel_conductor(r.cos_h, load3(m.eta_specular), load3(m.k)) * r.f;
  return e;
}

INLINE BsdfSample rough_conductor_sample(Material m, real3 wo, real u, real v) {
  BsdfSample s = bsdf_sample_none();
  real alpha = (real)m.alpha;
  real3 h = ggx_sample_visible(wo, alpha, u, v);
  s.wi = reflect_about(wo, h);
  if (s.wi.z < (real)COS_MIN) return bsdf_sample_none();
  real vo = ggx_v(wo, alpha), vi = ggx_v(s.wi, alpha);
  s.pdf_w = REAL(0.5) * ggx_d(h, alpha) / (wo.z + vo);
  s.weight = fresnel_conductor(r_min(dot3(wo, h), REAL(1.0)), load3(m.eta_specular), load3(m.k)) *
             ((wo.z + vo) * s.wi.z / (vo * s.wi.z + vi * wo.z));
  return s;
}

#endif

// Modified Phong: diffuse / pi + specular (n+2)/(2 pi) cos^n(angle to the mirror direction)
// [Lafortune94].
#ifndef PELLUCID_BSDF_PHONG_H
#define PELLUCID_BSDF_PHONG_H

#include "bsdf/lobe.h"
#include "core/frame.h"

INLINE BsdfEval phong_eval(Material m, real3 wo, real3 wi) {
  BsdfEval e = bsdf_eval_none();
  if (wi.z <= REAL(0.0)) return e;
  real n = (real)m.eta_specular.w;
  real prob_diffuse = (real)m.reflectance.w;
  real cos_a = r_clamp(wo.z * wi.z - wo.x * wi.x - wo.y * wi.y, REAL(0.0), REAL(1.0));
  // No lobe behind the mirror direction: 0^0 = 1 would put one there for n = 0.
  real lobe = cos_a > REAL(0.0) ? pow_unit(cos_a, n) * INV_TWO_PI : REAL(0.0);
  e.f = load3(m.reflectance) * INV_PI + load3(m.eta_specular) * ((n + REAL(2.0)) * lobe);
  e.pdf_w = prob_diffuse * wi.z * INV_PI + (REAL(1.0) - prob_diffuse) * (n + REAL(1.0)) * lobe;
  return e;
}

INLINE BsdfSample phong_sample(Material m, real3 wo, real lobe, real u, real v) {
  BsdfSample s = bsdf_sample_none();
  if (lobe < (real)m.reflectance.w) {
    s.wi = warp_cosine_hemisphere(u, v);
  } else {
    // cos(alpha) = (1-u)^(1/(n+1)) around the mirror direction
    real n = (real)m.eta_specular.w;
    real cos_a = pow_unit(REAL(1.0) - u, REAL(1.0) / (n + REAL(1.0)));
    real sin_a = safe_sqrt((REAL(1.0) - cos_a) * (REAL(1.0) + cos_a));
    SinCos phi = sincos_2pi(v);
    Frame frame = frame_from_normal(REAL3(-wo.x, -wo.y, wo.z));
    s.wi = normalize3(to_world(frame, REAL3(sin_a * phi.c, sin_a * phi.s, cos_a)));
  }
  BsdfEval e = phong_eval(m, wo, s.wi);
  if (e.pdf_w <= REAL(0.0)) return bsdf_sample_none();
  s.pdf_w = e.pdf_w;
  s.weight = e.f * (s.wi.z / e.pdf_w);
  return s;
}

#endif

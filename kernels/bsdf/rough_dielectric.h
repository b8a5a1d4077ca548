// Rough glass: GGX reflection and refraction [Walter07 eq. 20, 21, 41], visible normals.
#ifndef PELLUCID_BSDF_ROUGH_DIELECTRIC_H
#define PELLUCID_BSDF_ROUGH_DIELECTRIC_H

#include "bsdf/fresnel.h"
#include "bsdf/ggx.h"

INLINE BsdfEval rough_dielectric_eval(Material m, BsdfContext c, real3 wi) {
  BsdfEval e = bsdf_eval_none();
  real alpha = (real)m.alpha;
  real3 wo = c.wo;
  int reflection = wi.z > REAL(0.0);
  real3 h = reflection ? wo + wi : wo + wi * c.eta;
  real len2 = dot3(h, h);
  if (len2 == REAL(0.0)) return e;
  h = h * (REAL(1.0) / r_sqrt(len2));
  if (h.z < REAL(0.0)) h = -h;
  real wo_h = dot3(wo, h), wi_h = dot3(wi, h);
  // Facets seen from behind scatter nothing.
  if (wo_h <= REAL(0.0) || (reflection ? wi_h <= REAL(0.0) : wi_h >= REAL(0.0))) return e;
  real cos_t;
  real fresnel = fresnel_dielectric(r_min(wo_h, REAL(1.0)), c.eta, &cos_t);
  real vo = ggx_v(wo, alpha), cos_i = r_abs(wi.z);
  real d = ggx_d(h, alpha);
  real g1 = REAL(1.0) / (wo.z + vo);                             // over 2 wo.z
  real g2 = REAL(1.0) / (vo * cos_i + ggx_v(wi, alpha) * wo.z);  // over 2 wo.z cos_i
  real f;
  if (reflection) {
    e.pdf_w = REAL(0.5) * fresnel * d * g1;
    f = REAL(0.5) * fresnel * d * g2;
  } else {
    real root = wo_h + c.eta * wi_h;
    real jacobian = c.eta * c.eta * -wi_h / (root * root);
    real transmitted = (REAL(1.0) - fresnel) * d * wo_h * jacobian;
    e.pdf_w = REAL(2.0) * transmitted * g1;
    f = REAL(2.0) * transmitted * g2;
    if (!c.importance) f = f / (c.eta * c.eta);
  }
  e.f = REAL3(f, f, f);
  return e;
}

INLINE BsdfSample rough_dielectric_sample(Material m, BsdfContext c, real lobe, real u, real v) {
  BsdfSample s = bsdf_sample_none();
  real alpha = (real)m.alpha;
  real3 wo = c.wo;
  real3 h = ggx_sample_visible(wo, alpha, u, v);
  real wo_h = r_min(dot3(wo, h), REAL(1.0));
  if (wo_h <= REAL(0.0)) return s;
  real cos_t;
  real fresnel = fresnel_dielectric(wo_h, c.eta, &cos_t);
  real vo = ggx_v(wo, alpha);
  real visible = ggx_d(h, alpha) * REAL(2.0) / (wo.z + vo);  // over wo.h
  real weight = REAL(1.0);
  if (lobe < fresnel) {
    s.wi = reflect_about(wo, h);
    if (s.wi.z < (real)COS_MIN) return bsdf_sample_none();
    s.pdf_w = fresnel * visible * REAL(0.25);
  } else {
    s.wi = refract_about(wo, h, c.eta, wo_h, cos_t);
    if (s.wi.z > -(real)COS_MIN) return bsdf_sample_none();
    real root = wo_h - c.eta * cos_t;
    s.pdf_w = (REAL(1.0) - fresnel) * visible * wo_h * c.eta * c.eta * cos_t / (root * root);
    if (!c.importance) weight = REAL(1.0) / (c.eta * c.eta);
  }
  real cos_i = r_abs(s.wi.z);
  weight *= (wo.z + vo) * cos_i / (vo * cos_i + ggx_v(s.wi, alpha) * wo.z);
  s.weight = REAL3(weight, weight, weight);
  return s;
}

#endif

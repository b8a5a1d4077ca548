// Plastic: a diffuse base under a dielectric coat, smooth or GGX. Light that enters scatters at the
// base, bounces between base and coat until it leaves, and is counted to the end in closed form:
// f = T(o) T(i) rho / (pi n^2 (1 - rho F)), T: Fresnel transmittance of the coat, F: share of
// diffuse light inside that the coat throws back. Under a smooth coat a white base loses nothing:
// R(o) + T(o) = 1.
#ifndef PELLUCID_BSDF_PLASTIC_H
#define PELLUCID_BSDF_PLASTIC_H

#include "bsdf/ggx.h"
#include "bsdf/specular.h"

/// What of the light that has entered the coat comes out again.
INLINE real3 plastic_base(Material m) {
  real3 rho = load3(m.reflectance);
  real inner = (real)m.eta_specular.x;
  return rho * (REAL(1.0) - inner) / (-rho * inner + REAL(1.0));
}

/// Probability to sample the coat: its share of what goes back towards wo. A function of wo.z
/// alone, so the same for a walk from the other end of a mirrored direction.
INLINE real plastic_coat_prob(real reflected, real3 base) {
  real both = reflected + (REAL(1.0) - reflected) * max3(base);
  return both > REAL(0.0) ? reflected / both : REAL(1.0);
}

/// The base alone; density included the choice of lobe.
INLINE BsdfEval plastic_eval(Material m, real3 wo, real3 wi) {
  BsdfEval e = bsdf_eval_none();
  if (wi.z <= REAL(0.0)) return e;
  real n = (real)m.ior, cos_t;
  real reflected_o = fresnel_dielectric(wo.z, n, &cos_t);
  real reflected_i = fresnel_dielectric(wi.z, n, &cos_t);
  real3 base = plastic_base(m);
  // Diffuse light from outside enters by n^2 (1 - F), the mean of T.
  real entering = n * n * (REAL(1.0) - (real)m.eta_specular.x);
  e.f = base * ((REAL(1.0) - reflected_o) * (REAL(1.0) - reflected_i) / entering * INV_PI);
  e.pdf_w = (REAL(1.0) - plastic_coat_prob(reflected_o, base)) * wi.z * INV_PI;
  return e;
}

/// Base and coat.
INLINE BsdfEval rough_plastic_eval(Material m, real3 wo, real3 wi) {
  BsdfEval e = plastic_eval(m, wo, wi);
  if (wi.z <= REAL(0.0)) return e;
  real n = (real)m.ior, cos_t;
  GgxReflection coat = ggx_reflection(wo, wi, (real)m.alpha);
  e.f = e.f + fresnel_dielectric(coat.cos_h, n, &cos_t) * coat.f;
  real prob = plastic_coat_prob(fresnel_dielectric(wo.z, n, &cos_t), plastic_base(m));
  e.pdf_w += prob * coat.pdf_w;
  return e;
}

/// Finishes a sample of a direction whose lobes all have densities.
INLINE BsdfSample plastic_weigh(BsdfEval e, real3 wi) {
  BsdfSample s = bsdf_sample_none();
  if (e.pdf_w <= REAL(0.0)) return s;
  s.wi = wi;
  s.pdf_w = e.pdf_w;
  s.weight = e.f * (wi.z / e.pdf_w);
  return s;
}

INLINE BsdfSample plastic_sample(Material m, real3 wo, real lobe, real u, real v) {
  real cos_t;
  real reflected = fresnel_dielectric(wo.z, (real)m.ior, &cos_t);
  real prob = plastic_coat_prob(reflected, plastic_base(m));
  if (lobe < prob) {
    real weight = reflected / prob;
    return mirror_sample(wo, REAL3(weight, weight, weight));
  }
  real3 wi = warp_cosine_hemisphere(u, v);
  return plastic_weigh(plastic_eval(m, wo, wi), wi);
}

INLINE BsdfSample rough_plastic_sample(Material m, real3 wo, real lobe, real u, real v) {
  real cos_t;
  real reflected = fresnel_dielectric(wo.z, (real)m.ior, &cos_t);
  real3 wi;
  if (lobe < plastic_coat_prob(reflected, plastic_base(m))) {
    wi = reflect_about(wo, ggx_sample_visible(wo, (real)m.alpha, u, v));
    if (wi.z < (real)COS_MIN) return bsdf_sample_none();
  } else {
    wi = warp_cosine_hemisphere(u, v);
  }
  return plastic_weigh(rough_plastic_eval(m, wo, wi), wi);
}

#endif

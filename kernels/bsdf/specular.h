// The delta lobes: perfect mirror, smooth metal, smooth glass, thin panes. Nothing to evaluate,
// only to sample.
#ifndef PELLUCID_BSDF_SPECULAR_H
#define PELLUCID_BSDF_SPECULAR_H

#include "bsdf/fresnel.h"
#include "bsdf/lobe.h"

INLINE BsdfSample mirror_sample(real3 wo, real3 reflectance) {
  BsdfSample s = bsdf_sample_none();
  s.delta = 1;
  s.wi = REAL3(-wo.x, -wo.y, wo.z);
  s.weight = reflectance;
  return s;
}

/// Reflects with the Fresnel probability, so that weights are 1 (or 1/eta^2) and both ways agree.
INLINE BsdfSample dielectric_sample(BsdfContext c, real lobe) {
  BsdfSample s = bsdf_sample_none();
  s.delta = 1;
  real cos_t;
  real reflectance = fresnel_dielectric(c.wo.z, c.eta, &cos_t);
  if (lobe < reflectance) {
    s.wi = REAL3(-c.wo.x, -c.wo.y, c.wo.z);
    s.weight = REAL3(1.0f, 1.0f, 1.0f);
  } else {
    real inv = REAL(1.0) / c.eta;
    s.wi = REAL3(-c.wo.x * inv, -c.wo.y * inv, -cos_t);
    // n^2 cos dw is the same on both sides [Veach97 5.2].
    s.reverse = c.wo.z * inv * inv / cos_t;
    real scale = c.importance ? REAL(1.0) : inv * inv;
    s.weight = REAL3(scale, scale, scale);
  }
  return s;
}

/// A pane of glass without thickness. All echoes between its faces together: with r at one face,
/// r + (1-r)^2 r (1 + r^2 + ...) = 2 r / (1 + r) goes back, the rest straight on; the index scales
/// radiance up at one face and down at the other.
INLINE BsdfSample thin_dielectric_sample(Material m, real3 wo, real lobe) {
  BsdfSample s = bsdf_sample_none();
  s.delta = 1;
  real cos_t;
  real face = fresnel_dielectric(wo.z, (real)m.ior, &cos_t);
  s.wi = lobe < REAL(2.0) * face / (REAL(1.0) + face) ? REAL3(-wo.x, -wo.y, wo.z) : -wo;
  s.weight = REAL3(1.0f, 1.0f, 1.0f);
  return s;
}

#endif

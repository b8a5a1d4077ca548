// Fresnel reflectances for unpolarised light and the bending of directions. Local frame: wo.z > 0.
#ifndef PELLUCID_BSDF_FRESNEL_H
#define PELLUCID_BSDF_FRESNEL_H

#include "core/real.h"

/// Reflectance of a dielectric met at cosine `cos_i` in [0, 1] with eta = transmitted / incident
/// index; *cos_t receives the cosine of the refracted direction (0 under total reflection). Written
/// without 1 - cos^2, which would see total reflection at grazing angles where eta is 1.
INLINE real fresnel_dielectric(real cos_i, real eta, PRIVATE real* cos_t) {
  real k2 = (eta - REAL(1.0)) * (eta + REAL(1.0)) + cos_i * cos_i;  // (eta cos_t)^2
  if (k2 <= REAL(0.0)) {
    *cos_t = REAL(0.0);
    return REAL(1.0);
  }
  real ct = r_min(r_sqrt(k2) / eta, REAL(1.0));
  *cos_t = ct;
  real parallel = (eta * cos_i - ct) / (eta * cos_i + ct);
  real perpendicular = (cos_i - eta * ct) / (cos_i + eta * ct);
  return REAL(0.5) * (parallel * parallel + perpendicular * perpendicular);
}

/// Reflectance of a conductor of index eta + i k met from vacuum at cosine `cos_i` [PBRT4 9.3.6].
INLINE real fresnel_conductor1(real cos_i, real eta, real k) {
  real c2 = cos_i * cos_i;
  real s2 = (REAL(1.0) - cos_i) * (REAL(1.0) + cos_i);
  real t0 = eta * eta - k * k - s2;
  real a2b2 = r_sqrt(t0 * t0 + REAL(4.0) * eta * eta * k * k);
  real a = safe_sqrt(REAL(0.5) * (a2b2 + t0));
  real t1 = a2b2 + c2, t2 = REAL(2.0) * a * cos_i;
  real rs = (t1 - t2) / (t1 + t2);
  real t3 = c2 * a2b2 + s2 * s2, t4 = t2 * s2;
  real rp = rs * (t3 - t4) / (t3 + t4);
  return REAL(0.5) * (rs + rp);
}
INLINE real3 fresnel_conductor(real cos_i, real3 eta, real3 k) {
  return REAL3(fresnel_conductor1(cos_i, eta.x, k.x), fresnel_conductor1(cos_i, eta.y, k.y),
               fresnel_conductor1(cos_i, eta.z, k.z));
}

/// wo mirrored about the unit normal h.
INLINE real3 reflect_about(real3 wo, real3 h) {
  return h * (REAL(2.0) * dot3(wo, h)) - wo;
}
/// wo bent at h (dot(wo, h) = cos_i > 0), given the cosine of the refracted direction.
INLINE real3 refract_about(real3 wo, real3 h, real eta, real cos_i, real cos_t) {
  return h * (cos_i / eta - cos_t) - wo * (REAL(1.0) / eta);
}

#endif

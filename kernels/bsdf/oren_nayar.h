// Rough diffuse reflection that keeps its energy: EON [Portsmouth24], single scattering between
// facets by Fujii's form of [Oren94] plus a multiple-scattering lobe. White stays white at every
// angle.
#ifndef PELLUCID_BSDF_OREN_NAYAR_H
#define PELLUCID_BSDF_OREN_NAYAR_H

#include "bsdf/lobe.h"

/// With roughness r the single-scattering albedo of a white surface is
/// E(mu) = A (1 + r G(mu) / pi), A = 1 / (1 + C r), and its cosine-weighted mean
/// Ebar = A (1 + r (C - D)). Differences from 1 are all that the code needs, and it writes them
/// without the subtraction: 1 - E = A r (C - G / pi), 1 - Ebar = A r D.
#define EON_C REAL(0.287793409210806) /* 1/2 - 2/(3 pi) */
#define EON_D REAL(0.215305196753882) /* 18/(15 pi) - 1/6 */

/// C - G(mu) / pi: what single scattering loses towards cosine mu, over A r. From C at normal
/// incidence to 0 at grazing.
INLINE real eon_loss(real mu) {
  real s = safe_sqrt((REAL(1.0) - mu) * (REAL(1.0) + mu));
  // tan (1 - sin^3), without its pole
  real bent = s * mu * (REAL(1.0) + s + s * s) / (REAL(1.0) + s);
  real g = s * (acos_unit(mu) - s * mu) + REAL(2.0) / REAL(3.0) * (bent - s);
  return r_max(EON_C - g * INV_PI, REAL(0.0));  // rounding only: the loss is nowhere negative
}

INLINE BsdfEval oren_nayar_eval(Material m, real3 wo, real3 wi) {
  BsdfEval e = bsdf_eval_none();
  if (wi.z <= REAL(0.0)) return e;
  real r = (real)m.alpha;
  real3 rho = load3(m.reflectance);
  real a = REAL(1.0) / (REAL(1.0) + EON_C * r);
  real s = wo.x * wi.x + wo.y * wi.y;  // wo.wi - cos cos
  real t = s > REAL(0.0) ? r_max(wo.z, wi.z) : REAL(1.0);
  real single = a * (REAL(1.0) + r * s / t);
  // (1 - E_o)(1 - E_i) / (1 - Ebar), which vanishes with r
  real multiple =
      a * r * eon_loss(r_min(wo.z, REAL(1.0))) * eon_loss(r_min(wi.z, REAL(1.0))) / EON_D;
  real lost = a * r * EON_D;  // 1 - Ebar
  real3 rho_multiple = rho * rho * (REAL(1.0) - lost) / (-rho * lost + REAL(1.0));
  e.f = (rho * single + rho_multiple * multiple) * INV_PI;
  e.pdf_w = wi.z * INV_PI;
  return e;
}

INLINE BsdfSample oren_nayar_sample(Material m, real3 wo, real u, real v) {
  BsdfSample s = bsdf_sample_none();
  s.wi = warp_cosine_hemisphere(u, v);
  BsdfEval e = oren_nayar_eval(m, wo, s.wi);
  s.pdf_w = e.pdf_w;
  s.weight = e.f * PI;
  return s;
}

#endif

// GGX microfacets with height-correlated Smith masking and sampling of visible normals. Tangent
// forms throughout: 1 - cos^2 would lose the whole lobe in float at small alpha (numerics 12).
#ifndef PELLUCID_BSDF_GGX_H
#define PELLUCID_BSDF_GGX_H

#include "bsdf/lobe.h"

/// D(h) [1/sr] for a unit h with h.z > 0 [Walter07 eq. 33].
INLINE real ggx_d(real3 h, real alpha) {
  real a2 = alpha * alpha;
  real k = h.z * h.z + (h.x * h.x + h.y * h.y) / a2;  // cos^2 (1 + tan^2 / alpha^2)
  return INV_PI / (a2 * k * k);
}
/// v = |w.z| sqrt(1 + alpha^2 tan^2), which stays finite at grazing angles: G1 = 2 z / (z + v),
/// correlated G2 = 2 z_o z_i / (v_o z_i + v_i z_o) [Heitz14 eq. 72, 99].
INLINE real ggx_v(real3 w, real alpha) {
  return r_sqrt(w.z * w.z + alpha * alpha * (w.x * w.x + w.y * w.y));
}

/// Visible normal for wo (wo.z > 0), density G1 max(0, wo.h) D / wo.z [Heitz18].
INLINE real3 ggx_sample_visible(real3 wo, real alpha, real u, real v) {
  real3 vh = normalize3(REAL3(alpha * wo.x, alpha * wo.y, wo.z));
  real len2 = vh.x * vh.x + vh.y * vh.y;
  real inv = len2 > REAL(0.0) ? REAL(1.0) / r_sqrt(len2) : REAL(0.0);
  real3 t1 = len2 > REAL(0.0) ? REAL3(-vh.y * inv, vh.x * inv, 0.0f) : REAL3(1.0f, 0.0f, 0.0f);
  real3 t2 = cross3(vh, t1);
  real3 disk = warp_disk(u, v);
  real s = REAL(0.5) * (REAL(1.0) + vh.z);
  real y = (REAL(1.0) - s) * safe_sqrt(REAL(1.0) - disk.x * disk.x) + s * disk.y;
  real z = safe_sqrt(REAL(1.0) - disk.x * disk.x - y * y);
  real3 n = t1 * disk.x + t2 * y + vh * z;
  return normalize3(REAL3(alpha * n.x, alpha * n.y, r_max(n.z, (real)FACET_COS_MIN)));
}

/// Reflection at facets, without their Fresnel reflectance.
typedef struct GgxReflection {
  real f;      // f(wo, wi) over that reflectance [1/sr]
  real pdf_w;  // density of wo mirrored about a visible normal [1/sr]
  real cos_h;  // cosine at which the facet is met
} GgxReflection;

/// Of two directions with z > 0 [Walter07 eq. 20; Heitz14].
INLINE GgxReflection ggx_reflection(real3 wo, real3 wi, real alpha) {
  GgxReflection r;
  real3 h = normalize3(wo + wi);
  real vo = ggx_v(wo, alpha), vi = ggx_v(wi, alpha);
  real half_d = REAL(0.5) * ggx_d(h, alpha);
  r.pdf_w = half_d / (wo.z + vo);
  r.f = half_d / (vo * wi.z + vi * wo.z);
  r.cos_h = r_min(dot3(wo, h), REAL(1.0));
  return r;
}

#endif

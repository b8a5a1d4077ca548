// The only dispatcher over lobes. To add one: a file here, a case in each function below, a kind in
// shared/layout.h, a flag in shared/features.h and its packing in host/pack/materials.cpp.
#ifndef PELLUCID_BSDF_BSDF_H
#define PELLUCID_BSDF_BSDF_H

#include "bsdf/diffuse.h"
#include "bsdf/oren_nayar.h"
#include "bsdf/phong.h"
#include "bsdf/plastic.h"
#include "bsdf/rough_conductor.h"
#include "bsdf/rough_dielectric.h"
#include "bsdf/specular.h"

/// The material scatters into single directions only: no NEE, no connection.
INLINE int bsdf_is_delta(Material m) {
  return (m.lobes & LOBE_SPREAD) == 0u;
}
/// Some of the light goes into single directions, beside which there may be others.
INLINE int bsdf_has_delta(Material m) {
  return (m.lobes & LOBE_DELTA) != 0u;
}
/// Light passes through: sides are told apart by the geometric normal.
INLINE int bsdf_is_transmissive(Material m) {
  return (m.lobes & LOBE_TRANSMIT) != 0u;
}

/// f and density of the non-delta part for local directions (see bsdf/lobe.h).
INLINE BsdfEval bsdf_eval(Material m, BsdfContext c, real3 wi) {
  if (c.wo.z < (real)COS_MIN || r_abs(wi.z) < (real)COS_MIN) return bsdf_eval_none();
  switch (m.kind) {
#if FEAT_DIFFUSE
    case MATERIAL_DIFFUSE:
      return diffuse_eval(m, wi);
#endif
#if FEAT_OREN_NAYAR
    case MATERIAL_OREN_NAYAR:
      return oren_nayar_eval(m, c.wo, wi);
#endif
#if FEAT_PHONG
    case MATERIAL_PHONG:
      return phong_eval(m, c.wo, wi);
#endif
#if FEAT_PLASTIC
    case MATERIAL_PLASTIC:
      return plastic_eval(m, c.wo, wi);
#endif
#if FEAT_ROUGH_PLASTIC
    case MATERIAL_ROUGH_PLASTIC:
      return rough_plastic_eval(m, c.wo, wi);
#endif
#if FEAT_ROUGH_CONDUCTOR
    case MATERIAL_ROUGH_CONDUCTOR:
      return rough_conductor_eval(m, c.wo, wi);
#endif
#if FEAT_ROUGH_DIELECTRIC
    case MATERIAL_ROUGH_DIELECTRIC:
      return rough_dielectric_eval(m, c, wi);
#endif
    default:
      return bsdf_eval_none();
  }
}

/// Draws wi; `lobe`, `u`, `v` in [0, 1).
INLINE BsdfSample bsdf_sample(Material m, BsdfContext c, real lobe, real u, real v) {
  if (c.wo.z < (real)COS_MIN) return bsdf_sample_none();
  switch (m.kind) {
#if FEAT_DIFFUSE
    case MATERIAL_DIFFUSE:
      return diffuse_sample(m, u, v);
#endif
#if FEAT_OREN_NAYAR
    case MATERIAL_OREN_NAYAR:
      return oren_nayar_sample(m, c.wo, u, v);
#endif
#if FEAT_PHONG
    case MATERIAL_PHONG:
      return phong_sample(m, c.wo, lobe, u, v);
#endif
#if FEAT_PLASTIC
    case MATERIAL_PLASTIC:
      return plastic_sample(m, c.wo, lobe, u, v);
#endif
#if FEAT_ROUGH_PLASTIC
    case MATERIAL_ROUGH_PLASTIC:
      return rough_plastic_sample(m, c.wo, lobe, u, v);
#endif
#if FEAT_MIRROR
    case MATERIAL_MIRROR:
      return mirror_sample(c.wo, load3(m.reflectance));
#endif
#if FEAT_CONDUCTOR
    case MATERIAL_CONDUCTOR:
      return mirror_sample(c.wo, fresnel_conductor(c.wo.z, load3(m.eta_specular), load3(m.k)));
#endif
#if FEAT_ROUGH_CONDUCTOR
    case MATERIAL_ROUGH_CONDUCTOR:
      return rough_conductor_sample(m, c.wo, u, v);
#endif
#if FEAT_DIELECTRIC
    case MATERIAL_DIELECTRIC:
      return dielectric_sample(c, lobe);
#endif
#if FEAT_ROUGH_DIELECTRIC
    case MATERIAL_ROUGH_DIELECTRIC:
      return rough_dielectric_sample(m, c, lobe, u, v);
#endif
#if FEAT_THIN_DIELECTRIC
    case MATERIAL_THIN_DIELECTRIC:
      return thin_dielectric_sample(m, c.wo, lobe);
#endif
    default:
      return bsdf_sample_none();
  }
}

#endif

// The only dispatcher over lobes. To add one: a file here, a case in each function below, a kind in
// shared/layout.h, a flag in shared/features.h and its packing in host/pack/materials.cpp.
#ifndef PELLUCID_BSDF_BSDF_H
#define PELLUCID_BSDF_BSDF_H

#include "bsdf/diffuse.h"
#include "bsdf/phong.h"
#include "bsdf/rough_conductor.h"
#include "bsdf/rough_dielectric.h"
#include "bsdf/specular.h"

/// The material scatters into single directions only: no NEE, no connection.
INLINE int bsdf_is_delta(Material m) {
  return m.kind == MATERIAL_MIRROR || m.kind == MATERIAL_CONDUCTOR || m.kind == MATERIAL_DIELECTRIC;
}
/// Light passes through: sides are told apart by the geometric normal.
INLINE int bsdf_is_transmissive(Material m) {
  return m.kind == MATERIAL_DIELECTRIC || m.kind == MATERIAL_ROUGH_DIELECTRIC;
}

/// f and density of the non-delta part for local directions (see bsdf/lobe.h).
INLINE BsdfEval bsdf_eval(Material m, BsdfContext c, real3 wi) {
  if (c.wo.z < (real)COS_MIN || r_abs(wi.z) < (real)COS_MIN) return bsdf_eval_none();
  switch (m.kind) {
#if FEAT_DIFFUSE
    case MATERIAL_DIFFUSE:
      return diffuse_eval(m, wi);
#endif
#if FEAT_PHONG
    case MATERIAL_PHONG:
      return phong_eval(m, c.wo, wi);
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
#if FEAT_PHONG
    case MATERIAL_PHONG:
      return phong_sample(m, c.wo, lobe, u, v);
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
    default:
      return bsdf_sample_none();
  }
}

#endif

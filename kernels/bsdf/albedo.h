// The colour of a material as denoisers and compositors want it: what it sends back of white light
// met straight on.
#ifndef PELLUCID_BSDF_ALBEDO_H
#define PELLUCID_BSDF_ALBEDO_H

#include "bsdf/fresnel.h"
#include "bsdf/plastic.h"
#include "shared/layout.h"

/// In [0, 1]. Metals: Fresnel at normal incidence; glass keeps all light: 1.
INLINE real3 bsdf_albedo(Material m) {
  switch (m.kind) {
#if FEAT_PHONG
    case MATERIAL_PHONG:
      return load3(m.reflectance) + load3(m.eta_specular);
#endif
#if FEAT_CONDUCTOR || FEAT_ROUGH_CONDUCTOR
    case MATERIAL_CONDUCTOR:
    case MATERIAL_ROUGH_CONDUCTOR:
      return fresnel_conductor(REAL(1.0), load3(m.eta_specular), load3(m.k));
#endif
#if FEAT_PLASTIC || FEAT_ROUGH_PLASTIC
    case MATERIAL_PLASTIC:
    case MATERIAL_ROUGH_PLASTIC: {
      real cos_t;
      real coat = fresnel_dielectric(REAL(1.0), (real)m.ior, &cos_t);
      return plastic_base(m) * (REAL(1.0) - coat) + coat;
    }
#endif
#if FEAT_DIELECTRIC || FEAT_ROUGH_DIELECTRIC || FEAT_THIN_DIELECTRIC
    case MATERIAL_DIELECTRIC:
    case MATERIAL_ROUGH_DIELECTRIC:
    case MATERIAL_THIN_DIELECTRIC:
      return REAL3(1.0f, 1.0f, 1.0f);
#endif
    default:
      return load3(m.reflectance);
  }
}

#endif

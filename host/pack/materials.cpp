// Materials: human values to what lobes read.
#include <algorithm>

#include "base/error.h"
#include "pack/packer.h"

namespace pellucid {
namespace {

double largest(const Rgb& c) {
  return std::max({c.x, c.y, c.z});
}

/// Reflectance of a conductor at normal incidence.
Rgb normal_reflectance(const Rgb& eta, const Rgb& k) {
  const Rgb k2 = k * k;
  return ((eta - 1.0) * (eta - 1.0) + k2) / ((eta + 1.0) * (eta + 1.0) + k2);
}

/// Roulette survives with the material's albedo: local, so known to walks from either end.
float survive(double albedo) {
  return static_cast<float>(std::clamp(albedo, 0.0, 1.0));
}

/// Compared as the kernels see it: 0.001 in a scene file is at the limit, not below it.
bool wide_enough(const Material& m) {
  return float(m.alpha) >= ALPHA_DELTA;
}

void pack_conductor(const Material& m, ::Material& out, FeatureSet& features) {
  const bool rough = wide_enough(m);
  out.kind = rough ? MATERIAL_ROUGH_CONDUCTOR : MATERIAL_CONDUCTOR;
  features.set(rough ? FEAT_ROUGH_CONDUCTOR : FEAT_CONDUCTOR);
  out.eta_specular = to_f4(m.eta);
  out.k = to_f4(m.k);
  out.survive = survive(largest(normal_reflectance(m.eta, m.k)));
}

void pack_dielectric(const Material& m, ::Material& out, FeatureSet& features) {
  // An index-matched rough surface has no half vector for refraction; it does nothing to light
  // anyway.
  const bool rough = wide_enough(m) && std::abs(m.ior - 1.0) >= double(IOR_MATCHED);
  out.kind = rough ? MATERIAL_ROUGH_DIELECTRIC : MATERIAL_DIELECTRIC;
  features.set(rough ? FEAT_ROUGH_DIELECTRIC : FEAT_DIELECTRIC);
  out.survive = 1.0f;
}

void pack_phong(const Material& m, ::Material& out, FeatureSet& features) {
  out.kind = MATERIAL_PHONG;
  features.set(FEAT_PHONG);
  const double diffuse = largest(m.reflectance), specular = largest(m.specular);
  const double prob_diffuse = diffuse + specular > 0.0 ? diffuse / (diffuse + specular) : 1.0;
  out.reflectance = to_f4(m.reflectance, prob_diffuse);
  out.untextured = float(specular);
  out.eta_specular = to_f4(m.specular, m.exponent);
  out.survive = survive(largest(m.reflectance + m.specular));
}

}  // namespace

::Material pack_material(const Material& m, FeatureSet& features) {
  ::Material out{};
  out.alpha = float(m.alpha);
  out.ior = float(m.ior);
  out.reflectance = to_f4(m.reflectance);
  out.texture = m.texture ? uint(*m.texture) : NONE;
  out.survive = survive(largest(m.reflectance));
  switch (m.kind) {
    case MaterialKind::diffuse:
      out.kind = MATERIAL_DIFFUSE;
      features.set(FEAT_DIFFUSE);
      break;
    case MaterialKind::mirror:
      out.kind = MATERIAL_MIRROR;
      features.set(FEAT_MIRROR);
      break;
    case MaterialKind::conductor:
      pack_conductor(m, out, features);
      break;
    case MaterialKind::dielectric:
      pack_dielectric(m, out, features);
      break;
    case MaterialKind::phong:
      pack_phong(m, out, features);
      break;
  }
  return out;
}

}  // namespace pellucid

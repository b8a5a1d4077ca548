// Materials: human values to what lobes read.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

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

/// GGX alpha of the widest spread lobe, or what a Phong lobe comes to [Walter07 5.2]; 1 where there
/// are others.
double lobe_width(const ::Material& m) {
  if (m.kind == MATERIAL_ROUGH_CONDUCTOR || m.kind == MATERIAL_ROUGH_DIELECTRIC)
    return double(m.alpha);
  if (m.kind == MATERIAL_PHONG && m.reflectance.w == 0.0f)
    return std::sqrt(2.0 / (double(m.eta_specular.w) + 2.0));
  return 1.0;
}

/// What a dielectric of index n > 1 reflects of diffuse light from outside: the mean of Fresnel's
/// reflectance weighted by the cosine, by Simpson's rule in the cosine (smooth, as n > 1).
double diffuse_reflectance(double n) {
  constexpr int steps = 2000;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double c = double(i) / steps, t = std::sqrt((n - 1) * (n + 1) + c * c) / n;
    const double denominator = n * c + t;
    const double p = denominator > 0 ? (n * c - t) / denominator : 1.0;
    const double s = c + n * t > 0 ? (c - n * t) / (c + n * t) : 1.0;
    sum += (i == 0 || i == steps ? 1 : i % 2 ? 4 : 2) * 2 * c * 0.5 * (p * p + s * s);
  }
  return sum / (3.0 * steps);
}

void pack_plastic(const Material& m, ::Material& out, FeatureSet& features) {
  const bool rough = wide_enough(m);
  out.kind = rough ? MATERIAL_ROUGH_PLASTIC : MATERIAL_PLASTIC;
  features.set(rough ? FEAT_ROUGH_PLASTIC : FEAT_PLASTIC);
  out.untextured = 1.0f;  // the coat sends back all light at grazing angles, whatever lies under it
  const double outside = diffuse_reflectance(m.ior);
  // n^2 times the share that enters a face is the share that leaves it: radiance scales by n^2.
  const double inside = 1.0 - (1.0 - outside) / (m.ior * m.ior);
  out.eta_specular = to_f4(Rgb(inside, 0.0, 0.0));
  const double rho = largest(m.reflectance);
  const double base = rho * (1.0 - inside) / (1.0 - rho * inside);
  // The albedo runs from little at normal incidence to 1 at grazing; the root of its mean lies
  // between them, so that grazing views of dark plastic do not pay for rare survivors.
  out.survive = survive(std::sqrt(outside + (1.0 - outside) * base));
}

/// What a kind does with light (mixes ask their parts).
uint lobes_of(uint kind) {
  switch (kind) {
    case MATERIAL_MIRROR:
    case MATERIAL_CONDUCTOR:
      return LOBE_DELTA;
    case MATERIAL_DIELECTRIC:
    case MATERIAL_THIN_DIELECTRIC:
      return LOBE_DELTA | LOBE_TRANSMIT;
    case MATERIAL_ROUGH_DIELECTRIC:
      return LOBE_SPREAD | LOBE_TRANSMIT;
    case MATERIAL_PLASTIC:
      return LOBE_DELTA | LOBE_SPREAD;
    default:
      return LOBE_SPREAD;
  }
}

/// Adds the parts of `m`, those of mixes in it included, times `weight`; parts of no weight are
/// left out.
void flatten(const Material& m, double weight,
             std::vector<std::pair<const Material*, double>>& all) {
  if (weight == 0.0) return;
  if (m.kind != MaterialKind::mix) {
    all.emplace_back(&m, weight);
    return;
  }
  for (const Material& part : m.parts) flatten(part, weight * part.weight, all);
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
    case MaterialKind::oren_nayar:
      out.kind = MATERIAL_OREN_NAYAR;
      out.alpha = float(m.roughness);
      features.set(FEAT_OREN_NAYAR);
      break;
    case MaterialKind::plastic:
      pack_plastic(m, out, features);
      break;
    case MaterialKind::thin_dielectric:
      out.kind = MATERIAL_THIN_DIELECTRIC;
      out.survive = 1.0f;
      features.set(FEAT_THIN_DIELECTRIC);
      break;
    case MaterialKind::mix:
      throw InternalError("a mix has no lobes of its own");
  }
  out.lobes = lobes_of(out.kind);
  if (lobe_width(out) < double(ALPHA_GATHER)) out.lobes |= LOBE_NARROW;
  out.weight = 1.0f;
  return out;
}

void pack_materials(const std::vector<Material>& materials, PackedScene& out) {
  out.materials.resize(materials.size());
  for (size_t i = 0; i < materials.size(); ++i) {
    std::vector<std::pair<const Material*, double>> parts;
    flatten(materials[i], 1.0, parts);
    PELLUCID_CHECK(!parts.empty(), "a mix has parts");
    if (parts.size() == 1) {  // nothing to mix
      out.materials[i] = pack_material(*parts[0].first, out.features);
      continue;
    }
    ::Material mix{};
    mix.kind = MATERIAL_MIX;
    mix.texture = NONE;
    mix.ior = mix.weight = 1.0f;
    mix.first_part = uint(out.materials.size());
    mix.part_count = uint(parts.size());
    double survives = 0.0;
    bool wide = false;
    for (const auto& [part, weight] : parts) {
      ::Material packed = pack_material(*part, out.features);
      packed.weight = float(weight);
      wide |= (packed.lobes & (LOBE_SPREAD | LOBE_NARROW)) == LOBE_SPREAD;
      mix.lobes |= packed.lobes;
      survives += weight * packed.survive;
      out.materials.push_back(packed);
    }
    if (wide) mix.lobes &= ~LOBE_NARROW;
    mix.survive = survive(survives);
    out.materials[i] = mix;
    out.features.set(FEAT_MIX);
  }
}

}  // namespace pellucid

// The cases, built through the packer so that its values are tested too.
#include "support/bsdf_cases.h"

#include <algorithm>
#include <cmath>

#include "pack/packer.h"
#include "scene/metals.h"

namespace pellucid::test {
namespace {

::Material packed(const Material& m) {
  FeatureSet ignored;
  return pack_material(m, ignored);
}

glm::dvec3 direction(double cosine, double azimuth) {
  const double sine = std::sqrt((1 - cosine) * (1 + cosine));
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

void add(std::vector<BsdfCase>& cases, const std::string& name, const ::Material& m, double eta) {
  for (double cosine : {1.0, 0.7, 0.15, 1e-3})
    cases.push_back({name + " cos " + std::to_string(cosine), m, direction(cosine, 0.6), eta});
}

Material kind_of(MaterialKind kind, const Rgb& reflectance, double ior, double alpha) {
  Material m;
  m.kind = kind;
  m.reflectance = reflectance;
  m.ior = ior;
  m.alpha = m.roughness = alpha;
  return m;
}

/// A mix of `parts` with the given weights.
Material mix_of(std::vector<Material> parts, const std::vector<double>& weights) {
  Material mix;
  mix.kind = MaterialKind::mix;
  mix.parts = std::move(parts);
  for (std::size_t i = 0; i < weights.size(); ++i) mix.parts[i].weight = weights[i];
  return mix;
}

/// Cases of a mix: `mirror` and `coat` are the weights of perfect mirrors and of smooth plastic of
/// index 1.5 in it, `eta` is the index of its glass.
void add_mix(std::vector<BsdfCase>& cases, const std::string& name, const Material& mix,
             double mirror, double coat, double eta) {
  PackedScene packed;
  pack_materials({mix}, packed);
  const std::size_t first = cases.size();
  add(cases, name, packed.materials[0], eta);
  for (std::size_t i = first; i < cases.size(); ++i) {
    cases[i].parts = packed.materials;
    cases[i].delta_albedo = mirror + coat * fresnel_of(cases[i].wo.z, 1.5);
  }
}

void add_mixes(std::vector<BsdfCase>& cases) {
  const auto kind = [](MaterialKind k, double value, double alpha) {
    Material m = kind_of(k, Rgb(value, 0.5 * value, 0.3), 1.5, alpha);
    m.eta = Rgb(0.2), m.k = Rgb(3.0);
    return m;
  };
  const Material paint = kind(MaterialKind::diffuse, 0.8, 0),
                 metal = kind(MaterialKind::conductor, 1, 0.3),
                 frosted = kind(MaterialKind::dielectric, 1, 0.3),
                 clay = kind(MaterialKind::oren_nayar, 0.6, 0.7),
                 mirror = kind(MaterialKind::mirror, 1, 0),
                 coated = kind(MaterialKind::plastic, 0.7, 0),
                 black = kind(MaterialKind::diffuse, 0, 0);
  add_mix(cases, "paint and metal", mix_of({paint, metal}, {0.6, 0.4}), 0, 0, 1.0);
  add_mix(cases, "black and metal", mix_of({black, metal}, {0.5, 0.5}), 0, 0, 1.0);
  add_mix(cases, "glass and clay", mix_of({frosted, clay}, {0.3, 0.7}), 0, 0, 1.5);
  add_mix(cases, "mirror and plastic", mix_of({mirror, coated}, {0.25, 0.75}), 0.25, 0.75, 1.0);
  const Material inner = mix_of({coated, metal}, {0.5, 0.5});
  add_mix(cases, "mix of mixes", mix_of({inner, mirror, clay}, {0.5, 0.2, 0.3}), 0.2, 0.25, 1.0);
}

/// The part with the narrowest lobe; a material that is no mix is its own.
const ::Material& sharpest(const BsdfCase& c) {
  const ::Material* found = &c.material;
  for (uint i = 0; i < c.material.part_count; ++i) {
    const ::Material& part = c.parts[c.material.first_part + i];
    const bool facets =
        part.kind == MATERIAL_ROUGH_DIELECTRIC || part.kind == MATERIAL_ROUGH_CONDUCTOR;
    if (facets || i == 0) found = &part;
  }
  return *found;
}

}  // namespace

::Material diffuse(const Rgb& reflectance) {
  Material m;
  m.kind = MaterialKind::diffuse;
  m.reflectance = reflectance;
  return packed(m);
}

::Material phong(const Rgb& diffuse, const Rgb& specular, double exponent) {
  Material m;
  m.kind = MaterialKind::phong;
  m.reflectance = diffuse;
  m.specular = specular;
  m.exponent = exponent;
  return packed(m);
}

::Material gold(double alpha) {
  Material m;
  m.kind = MaterialKind::conductor;
  m.alpha = alpha;
  const auto found = std::find_if(metals().begin(), metals().end(), [](const Metal& metal) {
    return metal.name == std::string("gold");
  });
  m.eta = found->eta;
  m.k = found->k;
  return packed(m);
}

::Material glass(double ior, double alpha) {
  Material m;
  m.kind = MaterialKind::dielectric;
  m.ior = ior;
  m.alpha = alpha;
  return packed(m);
}

::Material oren_nayar(const Rgb& reflectance, double roughness) {
  return packed(kind_of(MaterialKind::oren_nayar, reflectance, 1.5, roughness));
}

::Material plastic(const Rgb& reflectance, double ior, double alpha) {
  return packed(kind_of(MaterialKind::plastic, reflectance, ior, alpha));
}

::Material pane(double ior) {
  return packed(kind_of(MaterialKind::thin_dielectric, Rgb(0.0), ior, 0.0));
}

double fresnel_of(double cosine, double ior) {
  const double cos_t = std::sqrt(1 - (1 - cosine * cosine) / (ior * ior));
  const double s = (cosine - ior * cos_t) / (cosine + ior * cos_t);
  const double p = (ior * cosine - cos_t) / (ior * cosine + cos_t);
  return 0.5 * (s * s + p * p);
}

std::vector<BsdfCase> density_cases() {
  std::vector<BsdfCase> cases;
  add(cases, "diffuse", diffuse({0.8, 0.5, 0.2}), 1.0);
  for (double n : {0.0, 1.0, 90.0, 1e4})
    add(cases, "phong n " + std::to_string(n), phong({0.3, 0.2, 0.1}, {0.4, 0.5, 0.6}, n), 1.0);
  const double alphas[] = {1.0, 0.3, 0.05, 5e-3, 1e-3};
  for (double alpha : alphas) add(cases, "gold alpha " + std::to_string(alpha), gold(alpha), 1.0);
  for (double ior : {1.5, 1 / 1.5, 2.4, 1.0001})
    for (double alpha : alphas)
      add(cases, "glass ior " + std::to_string(ior) + " alpha " + std::to_string(alpha),
          glass(ior, alpha), ior);
  for (double r : {0.0, 0.3, 1.0})
    add(cases, "oren-nayar " + std::to_string(r), oren_nayar({0.8, 0.5, 1.0}, r), 1.0);
  for (double ior : {1.0, 1.5, 2.5}) {
    const std::size_t first = cases.size();
    add(cases, "plastic " + std::to_string(ior), plastic({0.7, 0.5, 0}, ior, 0), 1.0);
    for (std::size_t i = first; i < cases.size(); ++i)
      cases[i].delta_albedo = fresnel_of(cases[i].wo.z, ior);
  }
  for (double alpha : {1.0, 0.3, 0.05, 1e-3})
    add(cases, "rough plastic alpha " + std::to_string(alpha), plastic({0.7, 0.5, 0}, 1.5, alpha),
        1.0);
  add(cases, "black rough plastic", plastic({0, 0, 0}, 1.5, 0.1), 1.0);
  add_mixes(cases);
  return cases;
}

double half_vector_error(const BsdfCase& c, const glm::dvec3& wi) {
  const ::Material& m = sharpest(c);
  const bool dielectric = m.kind == MATERIAL_ROUGH_DIELECTRIC;
  if (!dielectric && m.kind != MATERIAL_ROUGH_CONDUCTOR && m.kind != MATERIAL_ROUGH_PLASTIC)
    return 0.0;
  constexpr double roundoffs = 8.0 * double(UNIT_ROUNDOFF);  // components of wo, wi and of the sum
  const glm::dvec3 sum = c.wo + wi * (wi.z > 0 ? 1.0 : c.eta);
  const double length = glm::length(sum);
  const double error = 4.0 * roundoffs / (length * m.alpha);
  if (!dielectric) return error;
  const double cos_h = std::abs(glm::dot(c.wo, sum)) / length;
  const double k2 = std::abs((c.eta - 1) * (c.eta + 1) + cos_h * cos_h);
  return error + roundoffs * (1 + 1 / length) / k2 + roundoffs / (length * cos_h);
}

LobeShape reflection_shape(const BsdfCase& c) {
  const glm::dvec3 mirror(-c.wo.x, -c.wo.y, c.wo.z);
  const ::Material& m = sharpest(c);
  switch (m.kind) {
    case MATERIAL_DIFFUSE:
    case MATERIAL_OREN_NAYAR:
    case MATERIAL_PLASTIC:
    case MATERIAL_MIRROR:  // of a mix that has no sharp lobe
      return {{0, 0, 1}, 1.0};
    case MATERIAL_PHONG:  // half the cells for the lobe, half for the diffuse part around it
      return {mirror, 1.0 / std::sqrt(double(c.material.eta_specular.w) + 1.0)};
    default:
      return {mirror, m.alpha};
  }
}

LobeShape transmission_shape(const BsdfCase& c) {
  const double alpha = sharpest(c).alpha;
  const glm::dvec3 bent(-c.wo.x / c.eta, -c.wo.y / c.eta, 0.0);
  const double cos_t = std::sqrt(std::max(0.0, 1 - glm::dot(bent, bent)));
  if (cos_t == 0.0) return {{bent.x, bent.y, -1e-3}, alpha};
  // Tilting the facet by one radian turns the refracted direction by this much.
  const double turn = std::abs(1 - c.wo.z / (c.eta * cos_t));
  return {{bent.x, bent.y, -cos_t}, alpha * std::min(1.0, turn)};
}

}  // namespace pellucid::test

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
  return cases;
}

double half_vector_error(const BsdfCase& c, const glm::dvec3& wi) {
  const bool dielectric = c.material.kind == MATERIAL_ROUGH_DIELECTRIC;
  if (!dielectric && c.material.kind != MATERIAL_ROUGH_CONDUCTOR) return 0.0;
  constexpr double roundoffs = 8.0 * double(UNIT_ROUNDOFF);  // components of wo, wi and of the sum
  const glm::dvec3 sum = c.wo + wi * (wi.z > 0 ? 1.0 : c.eta);
  const double length = glm::length(sum);
  const double error = 4.0 * roundoffs / (length * c.material.alpha);
  if (!dielectric) return error;
  const double cos_h = std::abs(glm::dot(c.wo, sum)) / length;
  const double k2 = std::abs((c.eta - 1) * (c.eta + 1) + cos_h * cos_h);
  return error + roundoffs * (1 + 1 / length) / k2 + roundoffs / (length * cos_h);
}

LobeShape reflection_shape(const BsdfCase& c) {
  const glm::dvec3 mirror(-c.wo.x, -c.wo.y, c.wo.z);
  switch (c.material.kind) {
    case MATERIAL_DIFFUSE:
      return {{0, 0, 1}, 1.0};
    case MATERIAL_PHONG:  // half the cells for the lobe, half for the diffuse part around it
      return {mirror, 1.0 / std::sqrt(double(c.material.eta_specular.w) + 1.0)};
    default:
      return {mirror, c.material.alpha};
  }
}

LobeShape transmission_shape(const BsdfCase& c) {
  const glm::dvec3 bent(-c.wo.x / c.eta, -c.wo.y / c.eta, 0.0);
  const double cos_t = std::sqrt(std::max(0.0, 1 - glm::dot(bent, bent)));
  if (cos_t == 0.0) return {{bent.x, bent.y, -1e-3}, c.material.alpha};
  // Tilting the facet by one radian turns the refracted direction by this much.
  const double turn = std::abs(1 - c.wo.z / (c.eta * cos_t));
  return {{bent.x, bent.y, -cos_t}, c.material.alpha * std::min(1.0, turn)};
}

}  // namespace pellucid::test

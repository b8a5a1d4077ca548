// CF17: sheets of every material under a uniform sky.
#include <cmath>

#include "closed_form_table.h"
#include "render_harness.h"
#include "stability/closed_forms.h"

namespace pellucid::test {
namespace {

/// CF17: a sheet of `material` at 60 degrees under the sky, from the front or from behind.
Case sheet(const Material& material, const Rgb& value, bool behind = false) {
  Case c{"", scene_named("sheet"), {{value, {}, {}}}, all, {}};
  c.scene.materials.at(0) = material;
  if (behind)
    for (glm::uvec3& t : std::get<Mesh>(c.scene.shapes.at(0).geometry).triangles)
      std::swap(t.y, t.z);
  return c;
}

constexpr double sheet_cosine = 0.5;

Case phong_sheet() {
  Material m;
  m.kind = MaterialKind::phong;
  m.reflectance = {0.2, 0.3, 0.4};
  m.specular = {0.6, 0.5, 0.3};
  m.exponent = 12;
  return sheet(m, m.reflectance + m.specular * phong_albedo(sheet_cosine, m.exponent));
}

Case metal_sheet(double alpha, const Rgb& eta, const Rgb& k) {
  Material m;
  m.kind = MaterialKind::conductor;
  m.alpha = alpha;
  m.eta = eta;
  m.k = k;
  Rgb value;
  for (int c = 0; c < 3; ++c)
    value[c] = alpha > 0 ? ggx_reflected(sheet_cosine, alpha, 1, eta[c], k[c])
                         : fresnel(sheet_cosine, 1, eta[c], k[c]);
  return sheet(m, value);
}

Case glass_sheet(double alpha, bool behind) {
  Material m;
  m.kind = MaterialKind::dielectric;
  m.alpha = alpha;
  const double near = behind ? 1.5 : 1.0, far = behind ? 1.0 : 1.5;
  const double r = fresnel(sheet_cosine, near, far, 0), scale = near * near / (far * far);
  const double value = alpha > 0 ? ggx_reflected(sheet_cosine, alpha, near, far, 0) +
                                       ggx_transmitted(sheet_cosine, alpha, near, far)
                                 : r + (1 - r) * scale;
  Case c = sheet(m, grey(value), behind);
  if (alpha == 0 && r == 1) c.targets[0].constant = material_only;  // total reflection
  return c;
}

Case oren_nayar_sheet(double r) {
  Material m;
  m.kind = MaterialKind::oren_nayar;
  m.reflectance = {0.3, 0.6, 0.9};
  m.roughness = r;
  Rgb value;
  for (int c = 0; c < 3; ++c) value[c] = oren_nayar_albedo(sheet_cosine, m.reflectance[c], r);
  return sheet(m, value);
}

/// R + T base, and the facets' reflection instead of R for a rough coat.
std::pair<Material, Rgb> plastic_and_albedo(double alpha) {
  Material m;
  m.kind = MaterialKind::plastic;
  m.reflectance = {0.1, 0.5, 0.9};
  m.alpha = alpha;
  const double r = fresnel(sheet_cosine, 1, m.ior, 0);
  const double coat = alpha > 0 ? ggx_reflected(sheet_cosine, alpha, 1, m.ior, 0) : r;
  Rgb value;
  for (int c = 0; c < 3; ++c) value[c] = coat + (1 - r) * plastic_base(m.reflectance[c], m.ior);
  return {m, value};
}

Case plastic_sheet(double alpha) {
  const auto [m, value] = plastic_and_albedo(alpha);
  return sheet(m, value);
}

/// Rough glass and a mix of plastic and mirror, in a mix of their own.
Case mix_sheet() {
  auto [plastic, plastic_value] = plastic_and_albedo(0);
  Material mirror, glass, inner, outer;
  mirror.kind = MaterialKind::mirror;
  mirror.reflectance = {0.8, 0.4, 0.6};
  glass.kind = MaterialKind::dielectric;
  glass.alpha = 0.4;
  inner.kind = outer.kind = MaterialKind::mix;
  plastic.weight = 0.75, mirror.weight = 0.25;
  inner.parts = {plastic, mirror};
  glass.weight = 0.3, inner.weight = 0.7;
  outer.parts = {glass, inner};
  const double through = ggx_reflected(sheet_cosine, glass.alpha, 1, glass.ior, 0) +
                         ggx_transmitted(sheet_cosine, glass.alpha, 1, glass.ior);
  return sheet(outer, 0.3 * through + 0.7 * (0.75 * plastic_value + 0.25 * mirror.reflectance));
}

}  // namespace

Table sheets() {
  const Rgb gold_eta(0.143, 0.375, 1.442), gold_k(3.983, 2.386, 1.603);
  return {{"cf17_oren_nayar", [] { return merged(oren_nayar_sheet(0.4)); }},
          {"cf17_oren_nayar_roughest", [] { return merged(oren_nayar_sheet(1)); }},
          {"cf17_plastic", [] { return merged(plastic_sheet(0)); }},
          {"cf17_rough_plastic", [] { return merged(plastic_sheet(0.4)); }},
          {"cf17_mix", [] { return merged(mix_sheet()); }},
          {"cf17_phong", [] { return merged(phong_sheet()); }},
          {"cf17_smooth_metal", [=] { return by_every_method(metal_sheet(0, gold_eta, gold_k)); }},
          {"cf17_rough_metal", [=] { return merged(metal_sheet(0.4, gold_eta, gold_k)); }},
          {"cf17_rough_mirror", [] { return merged(metal_sheet(0.5, Rgb(0.0), Rgb(1.0))); }},
          {"cf17_glass_front", [] { return by_every_method(glass_sheet(0, false)); }},
          {"cf17_glass_behind", [] { return by_every_method(glass_sheet(0, true)); }},
          {"cf17_rough_glass_front", [] { return merged(glass_sheet(0.4, false)); }},
          {"cf17_rough_glass_behind", [] { return merged(glass_sheet(0.4, true)); }}};
}

}  // namespace pellucid::test

// MTL materials in terms of ours. MTL describes a look, not physics; the rules stand in
// scenes/README.md.
#include "scene/mtl.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/principled.h"

namespace pellucid {
namespace {

Rgb to_rgb(const tinyobj::real_t (&c)[3]) {
  return {c[0], c[1], c[2]};
}

double largest(const Rgb& c) {
  return std::max({c.r, c.g, c.b});
}

bool is_glass(const tinyobj::material_t& mtl) {
  if (mtl.illum == 4 || mtl.illum == 6 || mtl.illum == 7 || mtl.illum == 9) return true;
  if (mtl.dissolve < 1.0f) return true;
  // Some exporters write a filter of all ones (or zeros) to every opaque material.
  const Rgb filter = to_rgb(mtl.transmittance);
  return filter != Rgb(0.0) && filter != Rgb(1.0);
}

/// The colour, scaled down where it would send back more light than it gets.
Rgb at_most_one(Rgb c, const std::string& name, const char* key,
                std::vector<std::string>& warnings) {
  const double most = largest(c);
  if (most <= 1.0) return c;
  warnings.push_back(
      fmt::format("MTL material \"{}\": {} was scaled down to at most 1", name, key));
  return c / most;
}

double at_most_one(double v, const std::string& name, const char* key,
                   std::vector<std::string>& warnings) {
  return at_most_one(Rgb(v), name, key, warnings).x;
}

/// 1 is what exporters write when they do not know.
double index_of(const tinyobj::material_t& mtl, double low, double high,
                std::vector<std::string>& warnings) {
  if (mtl.ior == 1.0f) return 1.5;
  const double ior = std::clamp<double>(mtl.ior, low, high);
  if (ior != mtl.ior)
    warnings.push_back(fmt::format("MTL material \"{}\": Ni {:g} was brought into {:g} to {:g}",
                                   mtl.name, mtl.ior, low, high));
  return ior;
}

Material convert_principled(const tinyobj::material_t& mtl, std::vector<std::string>& warnings) {
  Principled look;
  look.base_color = at_most_one(to_rgb(mtl.diffuse), mtl.name, "Kd", warnings);
  look.metallic = at_most_one(mtl.metallic, mtl.name, "Pm", warnings);
  look.roughness = at_most_one(mtl.roughness, mtl.name, "Pr", warnings);
  look.transmission = is_glass(mtl) ? 1.0 : 0.0;
  look.ior = index_of(mtl, 1.0, 3.0, warnings);
  return principled_material(look);
}

void convert_glossy(const tinyobj::material_t& mtl, Material& material,
                    std::vector<std::string>& warnings) {
  material.kind = MaterialKind::phong;
  material.specular = to_rgb(mtl.specular);
  material.exponent = std::min<double>(mtl.shininess, 1e6);
  if (material.exponent != mtl.shininess)
    warnings.push_back(fmt::format("MTL material \"{}\": Ns {:g} was brought down to 1e6", mtl.name,
                                   mtl.shininess));
  const double most = largest(material.reflectance + material.specular);
  if (most > 1.0) {
    material.reflectance /= most;
    material.specular /= most;
    warnings.push_back(
        fmt::format("MTL material \"{}\": Kd + Ks was scaled down to at most 1", mtl.name));
  }
}

}  // namespace

MtlSurface convert_mtl(const tinyobj::material_t& mtl, bool principled,
                       std::vector<std::string>& warnings) {
  MtlSurface surface;
  Material& material = surface.material;
  const Rgb kd = to_rgb(mtl.diffuse), ks = to_rgb(mtl.specular), ke = to_rgb(mtl.emission);
  if (ke != Rgb(0.0)) surface.emission = Emission{ke, 1};
  material.reflectance = kd;
  if (principled) {
    material = convert_principled(mtl, warnings);
  } else if (is_glass(mtl)) {
    material.kind = MaterialKind::dielectric;
    material.ior = index_of(mtl, 0.1, 10.0, warnings);
  } else if (mtl.illum == 3) {
    material.kind = MaterialKind::mirror;
    material.reflectance = at_most_one(ks != Rgb(0.0) ? ks : kd, mtl.name, "Ks", warnings);
  } else if (ks != Rgb(0.0) && mtl.shininess > 0.0f && mtl.illum != 1) {
    convert_glossy(mtl, material, warnings);
  } else {
    material.reflectance = at_most_one(kd, mtl.name, "Kd", warnings);
  }
  material.name = mtl.name;
  return surface;
}

}  // namespace pellucid

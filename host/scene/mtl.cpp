// MTL materials in terms of ours. MTL describes a look, not physics; the rules stand in
// scenes/README.md.
#include "scene/mtl.h"

#include <fmt/format.h>

#include <algorithm>

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

MtlSurface convert_mtl(const tinyobj::material_t& mtl, std::vector<std::string>& warnings) {
  MtlSurface surface;
  Material& material = surface.material;
  material.name = mtl.name;
  const Rgb kd = to_rgb(mtl.diffuse), ks = to_rgb(mtl.specular), ke = to_rgb(mtl.emission);
  material.reflectance = kd;
  if (ke != Rgb(0.0)) surface.emission = Emission{ke, 1};
  if (is_glass(mtl)) {
    material.kind = MaterialKind::dielectric;
    material.ior = std::clamp<double>(mtl.ior, 0.1, 10.0);
    if (material.ior != mtl.ior)
      warnings.push_back(fmt::format("MTL material \"{}\": Ni {:g} was brought into 0.1 to 10",
                                     mtl.name, mtl.ior));
    if (mtl.ior == 1.0f) material.ior = 1.5;  // 1 is what exporters write when they do not know
  } else if (mtl.illum == 3) {
    material.kind = MaterialKind::mirror;
    material.reflectance = at_most_one(ks != Rgb(0.0) ? ks : kd, mtl.name, "Ks", warnings);
  } else if (ks != Rgb(0.0) && mtl.shininess > 0.0f && mtl.illum != 1) {
    convert_glossy(mtl, material, warnings);
  } else {
    material.reflectance = at_most_one(kd, mtl.name, "Kd", warnings);
  }
  return surface;
}

}  // namespace pellucid

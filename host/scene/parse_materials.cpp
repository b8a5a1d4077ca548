// Materials of the scene file.
#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "scene/metals.h"
#include "scene/parse.h"
#include "scene/text_file.h"

namespace pellucid {
namespace {

/// GGX width from "roughness" or "alpha"; smooth where neither is given.
double parse_alpha(const ObjectReader& reader) {
  if (!reader.has("roughness") && !reader.has("alpha")) return 0.0;
  const std::string key = reader.exactly_one({"roughness", "alpha"});
  const double value = reader.number(key);
  return key == "roughness" ? value * value : value;
}

void parse_conductor(const ObjectReader& reader, Material& material) {
  material.kind = MaterialKind::conductor;
  material.alpha = parse_alpha(reader);
  if (reader.exactly_one({"metal", "eta"}) == "metal") {
    if (reader.has("k")) fail(reader.place("k"), "give \"metal\" or \"eta\" with \"k\", not both");
    const std::string name = reader.text("metal");
    for (const Metal& metal : metals()) {
      if (name != metal.name) continue;
      material.eta = metal.eta;
      material.k = metal.k;
    }
  } else {
    if (!reader.has("k")) fail(reader.place("eta"), "\"eta\" needs \"k\" beside it");
    material.eta = reader.color("eta");
    material.k = reader.color("k");
  }
}

void parse_phong(const ObjectReader& reader, Material& material) {
  material.kind = MaterialKind::phong;
  material.reflectance = reader.color("diffuse");
  material.specular = reader.color("specular");
  material.exponent = reader.number("exponent");
  const Rgb sum = material.reflectance + material.specular;
  constexpr double rounding = 1e-9;  // 0.3 + 0.7 may come out a little above 1
  for (int c = 0; c < 3; ++c)
    if (sum[c] > 1.0 + rounding)
      fail(reader.node(), fmt::format("diffuse + specular is {:g} in channel {}; it must be at "
                                      "most 1, or the surface would make light",
                                      sum[c], "rgb"[c]));
}

}  // namespace

Material parse_material(const JsonNode& node) {
  const ObjectSpec& spec = typed_spec(node, "material");
  const ObjectReader reader(node, spec);
  Material material;
  if (spec.name == "material/diffuse") {
    material.kind = MaterialKind::diffuse;
    material.reflectance = reader.color("reflectance");
  } else if (spec.name == "material/mirror") {
    material.kind = MaterialKind::mirror;
    material.reflectance = reader.color("reflectance");
  } else if (spec.name == "material/dielectric") {
    material.kind = MaterialKind::dielectric;
    material.ior = reader.number("ior");
    material.alpha = parse_alpha(reader);
  } else if (spec.name == "material/conductor") {
    parse_conductor(reader, material);
  } else {
    PELLUCID_CHECK(spec.name == "material/phong", "a material of the table has no parser");
    parse_phong(reader, material);
  }
  return material;
}

void parse_materials(const JsonNode& node, SceneBuilder& builder) {
  for (const JsonMember& member : node.members) {
    if (member.key.empty())
      fail_at(*node.source, member.key_offset, node.path, "a material's name must not be empty");
    Material material = parse_material(member.value);
    material.name = member.key;
    if (const JsonNode* texture = member.value.find("texture"))
      material.texture = parse_texture(*texture, builder);
    builder.material_index[member.key] = static_cast<int>(builder.scene.materials.size());
    builder.scene.materials.push_back(std::move(material));
  }
}

int find_material(const JsonNode& name, const SceneBuilder& builder) {
  const auto found = builder.material_index.find(name.text);
  if (found != builder.material_index.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& entry : builder.material_index) names.push_back(entry.first);
  fail(name, fmt::format("there is no material \"{}\".{} {}", printable(name.text),
                         did_you_mean(printable(name.text), names),
                         names.empty() ? "The scene has none."
                                       : "\"materials\" has " + list_choices(names)));
}

}  // namespace pellucid

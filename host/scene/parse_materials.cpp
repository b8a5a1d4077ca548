// Materials of the scene file.
#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/text.h"
#include "scene/metals.h"
#include "scene/parse.h"
#include "scene/principled.h"
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

Material parse_principled(const ObjectReader& reader) {
  Principled look;
  look.base_color = reader.color("baseColor");
  look.metallic = reader.number("metallic");
  look.transmission = reader.number("transmission");
  look.roughness = reader.number("roughness");
  look.ior = reader.number("ior");
  return principled_material(look);
}

/// A material that names no others, without its name.
Material parse_simple(const ObjectReader& reader, const ObjectSpec& spec) {
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
  } else if (spec.name == "material/thin-dielectric") {
    material.kind = MaterialKind::thin_dielectric;
    material.ior = reader.number("ior");
  } else if (spec.name == "material/conductor") {
    parse_conductor(reader, material);
  } else if (spec.name == "material/oren-nayar") {
    material.kind = MaterialKind::oren_nayar;
    material.reflectance = reader.color("reflectance");
    material.roughness = reader.number("roughness");
  } else if (spec.name == "material/plastic") {
    material.kind = MaterialKind::plastic;
    material.reflectance = reader.color("reflectance");
    material.ior = reader.number("ior");
    material.alpha = parse_alpha(reader);
  } else if (spec.name == "material/principled") {
    material = parse_principled(reader);
  } else {
    PELLUCID_CHECK(spec.name == "material/phong", "a material of the table has no parser");
    parse_phong(reader, material);
  }
  return material;
}

/// Every vertex on a mix evaluates all its parts, and mixes of mixes double them at every level.
constexpr std::size_t most_parts = 64;

/// Parses materials in the order of the file, but what a mix names before the mix.
class MaterialParser {
 public:
  MaterialParser(const JsonNode& node, SceneBuilder& builder)
      : node_(node), builder_(builder), done_(node.members.size(), false) {
    builder.scene.materials.resize(node.members.size());
  }

  void parse(std::size_t index) {
    if (done_[index]) return;
    const JsonMember& member = node_.members[index];
    open_.push_back(member.key);
    const ObjectSpec& spec = typed_spec(member.value, "material");
    const ObjectReader reader(member.value, spec);
    Material material =
        spec.name == "material/mix" ? parse_mix(reader) : parse_simple(reader, spec);
    material.name = member.key;
    if (const JsonNode* texture = member.value.find("texture"))
      material.texture = parse_texture(*texture, builder_);
    builder_.scene.materials[index] = std::move(material);
    done_[index] = true;
    open_.pop_back();
  }

 private:
  Material parse_mix(const ObjectReader& reader) {
    const JsonNode names = reader.value("materials");
    if (names.items.size() != 2) fail(names, "a mix needs two names of materials");
    const double amount = reader.number("amount");
    Material mix;
    mix.kind = MaterialKind::mix;
    for (std::size_t i : {0, 1}) {
      const JsonNode& name = names.items[i];
      read_text(name);
      const auto index = static_cast<std::size_t>(find_material(name, builder_));
      if (std::find(open_.begin(), open_.end(), name.text) != open_.end())
        fail(name, fmt::format("the mix \"{}\" would contain itself; name another material",
                               printable(name.text)));
      if (open_.size() > most_parts) fail(name, too_many());
      parse(index);
      mix.parts.push_back(builder_.scene.materials[index]);
      mix.parts.back().weight = i == 0 ? 1.0 - amount : amount;
    }
    if (count_parts(mix) > most_parts) fail(reader.node(), too_many());
    return mix;
  }

  static std::size_t count_parts(const Material& material) {
    std::size_t count = material.kind == MaterialKind::mix ? 0 : 1;
    for (const Material& part : material.parts) count += count_parts(part);
    return count;
  }
  static std::string too_many() {
    return fmt::format("mixes within mixes may have at most {} parts in all", most_parts);
  }

  const JsonNode& node_;
  SceneBuilder& builder_;
  std::vector<bool> done_;
  std::vector<std::string> open_;  ///< mixes being parsed, each named by the one before it
};

}  // namespace

void parse_materials(const JsonNode& node, SceneBuilder& builder) {
  int count = 0;
  for (const JsonMember& member : node.members) {
    if (member.key.empty())
      fail_at(*member.value.source, member.key_offset, node.path,
              "a material's name must not be empty");
    builder.material_index[member.key] = count++;
  }
  MaterialParser parser(node, builder);
  for (std::size_t i = 0; i < node.members.size(); ++i) parser.parse(i);
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

// OBJ models: tinyobjloader parses and triangulates, the rest is checks and regrouping.
#include "scene/obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <sstream>
#include <unordered_map>

#include "base/error.h"
#include "base/text.h"
#include "scene/mtl.h"
#include "scene/obj_scan.h"
#include "scene/text_file.h"

namespace pellucid {
namespace {

static_assert(sizeof(tinyobj::real_t) == sizeof(double), "far models lose their digits in floats");

constexpr const char* remedy =
    "; give the file, or give the shape a \"material\", which replaces those of the model";

/// Finds MTL files beside the OBJ file, and fails where tinyobjloader would only warn.
class LibraryReader : public tinyobj::MaterialReader {
 public:
  LibraryReader(std::string obj_path, bool lenient, Model& model)
      : obj_path_(std::move(obj_path)), lenient_(lenient), model_(model) {}

  /// What the files say beyond tinyobjloader.
  const MtlScan& scan() const { return scan_; }

  bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                  std::map<std::string, int>* index, std::string* warn, std::string* err) override {
    const auto path = (std::filesystem::path(obj_path_).parent_path() / name).string();
    std::string text;
    try {
      text = read_text_file(path, "material file", max_model_bytes);
    } catch (const InputError& error) {
      if (!lenient_)
        throw InputError(fmt::format("{} (named by '{}'){}", error.what(), obj_path_, remedy));
      model_.warnings.push_back(fmt::format("{} (named by '{}')", error.what(), obj_path_));
      return false;
    }
    scan_.merge(scan_mtl(path, text));
    model_.files.push_back(source_file(path, text));
    std::istringstream in(text);
    tinyobj::LoadMtl(index, materials, &in, warn, err);
    return true;
  }

 private:
  std::string obj_path_;
  bool lenient_;
  Model& model_;
  MtlScan scan_;
};

/// Fails where a face would be left without a material.
void check_materials(const std::string& path, const ObjScan& scan,
                     const std::vector<std::string>& files,
                     const std::vector<tinyobj::material_t>& materials) {
  if (scan.first_face_without_material > 0)
    throw InputError(fmt::format("{}:{}: the face has no material: no usemtl comes before it{}",
                                 path, scan.first_face_without_material, remedy));
  if (!scan.names_library)
    throw InputError(
        fmt::format("{}: there is usemtl, but no mtllib that names a file{}", path, remedy));
  std::vector<std::string> names;
  for (const tinyobj::material_t& material : materials)
    if (!material.name.empty())
      names.push_back(material.name);  // an empty file makes one of no name
  for (const auto& [name, line] : scan.materials)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw InputError(
          fmt::format("{}:{}: the material file {} has no material \"{}\".{} It has {}", path, line,
                      join(files), printable(name), did_you_mean(printable(name), names),
                      names.empty() ? "none" : list_choices(names)));
}

/// Collects the triangles of one part, sharing vertices that agree in position, normal and, where
/// they matter, texture coordinates.
class PartBuilder {
 public:
  PartBuilder(const tinyobj::attrib_t& attrib, bool smooth, bool textured)
      : attrib_(attrib), smooth_(smooth), textured_(textured) {}

  void add(const tinyobj::index_t* corners) {
    glm::dvec3 p[3];
    for (int i = 0; i < 3; ++i) p[i] = read(attrib_.vertices, corners[i].vertex_index);
    const glm::dvec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double area = glm::length(cross);
    const glm::dvec3 flat = area > 0.0 ? cross / area : glm::dvec3(0.0, 0.0, 1.0);
    glm::uvec3 triangle;
    for (int i = 0; i < 3; ++i) triangle[i] = vertex(corners[i], p[i], flat);
    mesh_.triangles.push_back(triangle);
  }

  /// Texture coordinates are all there or empty.
  RawMesh take() {
    if (corner_without_uv_) mesh_.uvs = {};
    return std::move(mesh_);
  }

 private:
  /// Indices of position, normal and texture coordinates.
  using Key = std::array<int, 3>;
  struct KeyHash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t hash = 0;
      for (const int index : key)  // multiplicative hashing by 2^64 over the golden ratio
        hash = (hash ^ static_cast<std::uint32_t>(index)) * 0x9e3779b97f4a7c15u;
      return hash ^ (hash >> 32);
    }
  };

  static glm::dvec3 read(const std::vector<tinyobj::real_t>& values, int index) {
    const auto at = static_cast<std::size_t>(index) * 3;
    PELLUCID_CHECK(index >= 0 && at + 2 < values.size(), "an OBJ index slipped through the scan");
    return {values[at], values[at + 1], values[at + 2]};
  }

  std::uint32_t vertex(const tinyobj::index_t& corner, glm::dvec3 p, glm::dvec3 flat) {
    const int normal = smooth_ ? corner.normal_index : -1;
    // A corner without a normal in a smooth part takes its face's, so it cannot be shared.
    const bool shared = !smooth_ || normal >= 0;
    const int uv = textured_ ? corner.texcoord_index : -1;
    const Key key = {corner.vertex_index, normal, uv};
    if (shared) {
      const auto found = known_.find(key);
      if (found != known_.end()) return found->second;
    }
    const auto index = static_cast<std::uint32_t>(mesh_.positions.size());
    mesh_.positions.push_back(p);
    if (smooth_) {
      const glm::dvec3 given = normal >= 0 ? read(attrib_.normals, normal) : flat;
      const double length = glm::length(given);
      mesh_.normals.push_back(length > 0.0 ? given / length : flat);
    }
    if (textured_) mesh_.uvs.push_back(read_uv(uv));
    if (shared) known_.emplace(key, index);
    return index;
  }

  glm::dvec2 read_uv(int index) {
    if (index < 0) {
      corner_without_uv_ = true;
      return glm::dvec2(0.0);
    }
    const auto at = static_cast<std::size_t>(index) * 2;
    PELLUCID_CHECK(at + 1 < attrib_.texcoords.size(), "an OBJ index slipped through the scan");
    return {attrib_.texcoords[at], attrib_.texcoords[at + 1]};
  }

  const tinyobj::attrib_t& attrib_;
  bool smooth_, textured_, corner_without_uv_ = false;
  RawMesh mesh_;
  std::unordered_map<Key, std::uint32_t, KeyHash> known_;
};

bool has_normals(const tinyobj::mesh_t& mesh) {
  return std::any_of(mesh.indices.begin(), mesh.indices.end(),
                     [](const tinyobj::index_t& i) { return i.normal_index >= 0; });
}

/// One part per material of one tinyobjloader shape, which is an object or a group.
void add_parts(const tinyobj::shape_t& shape, const tinyobj::attrib_t& attrib,
               const ModelOptions& options, const std::vector<bool>& textured, Model& model) {
  const bool smooth = options.use_normals && has_normals(shape.mesh);
  std::map<int, PartBuilder> builders;  // by material, in the order of the material file
  for (std::size_t t = 0; t < shape.mesh.num_face_vertices.size(); ++t) {
    const bool given = options.materials != ModelMaterials::replaced;
    const int material = given ? shape.mesh.material_ids[t] : no_material;
    const bool with_uvs = options.textured ||
                          (material != no_material && textured[static_cast<std::size_t>(material)]);
    const auto part = builders.try_emplace(material, attrib, smooth, with_uvs).first;
    part->second.add(&shape.mesh.indices[3 * t]);
  }
  for (auto& [material, builder] : builders)
    model.parts.push_back({shape.name, material, std::nullopt, builder.take()});
}

/// Fails where a material stands in a file that is named too late.
void check_parts(const std::string& path, const Model& model) {
  for (const ModelPart& part : model.parts)
    if (part.material == no_material)
      throw InputError(fmt::format(
          "{}: \"{}\" uses a material before the mtllib that holds it; move mtllib to the top",
          path, printable(part.name)));
}

/// Says once per model what was to have a material and has none.
void warn_of_missing(const std::string& path, const ObjScan& scan, Model& model) {
  const bool any = std::any_of(model.parts.begin(), model.parts.end(),
                               [](const ModelPart& part) { return part.material == no_material; });
  if (any && !scan.materials.empty())
    model.warnings.push_back(
        fmt::format("{}: faces whose material is in no material file are plain grey", path));
}

/// Converts one material; its map_Kd goes with it where the result has a base colour.
void convert_material(const tinyobj::material_t& mtl, const MtlScan& scan, Model& model,
                      std::vector<std::optional<Emission>>& emissions) {
  MtlSurface surface = convert_mtl(mtl, scan.principled.count(mtl.name) != 0, model.warnings);
  std::optional<MtlTexture> texture;
  const auto found = scan.textures.find(mtl.name);
  const MaterialKind kind = surface.material.kind;
  if (found != scan.textures.end()) {
    if (kind == MaterialKind::diffuse || kind == MaterialKind::phong ||
        kind == MaterialKind::plastic) {
      texture = found->second;
    } else {
      model.not_supported.emplace("MTL \"map_Kd\" of glass, metal and mirrors",
                                  found->second.place);
    }
  }
  model.materials.push_back(std::move(surface.material));
  model.textures.push_back(std::move(texture));
  emissions.push_back(surface.emission);
}

/// Converts the materials in use and renumbers the parts accordingly.
void convert_materials(const std::vector<tinyobj::material_t>& materials, const MtlScan& scan,
                       Model& model) {
  std::map<int, int> renumbered;
  std::vector<std::optional<Emission>> emissions;
  for (ModelPart& part : model.parts) {
    if (part.material == no_material) continue;
    const auto [entry, added] =
        renumbered.emplace(part.material, static_cast<int>(model.materials.size()));
    if (added) {
      convert_material(materials[static_cast<std::size_t>(part.material)], scan, model, emissions);
    }
    part.material = entry->second;
    const auto id = static_cast<std::size_t>(part.material);
    part.emission = emissions[id];
    if (model.textures[id] && part.mesh.uvs.empty())
      model.warnings.push_back(
          fmt::format("{}: map_Kd of \"{}\" is left out on {}, where faces have no texture "
                      "coordinates (vt)",
                      model.files.front().path, printable(model.materials[id].name),
                      part.name.empty() ? "a part" : '"' + printable(part.name) + '"'));
  }
}

/// Which materials have a texture. One without Kd is white under it, where tinyobjloader says 0.6.
std::vector<bool> find_textured(const MtlScan& scan, std::vector<tinyobj::material_t>& materials) {
  std::vector<bool> textured;
  for (tinyobj::material_t& material : materials) {
    textured.push_back(scan.textures.count(material.name) > 0);
    if (textured.back() && scan.coloured.count(material.name) == 0)
      for (tinyobj::real_t& value : material.diffuse) value = 1;
  }
  return textured;
}

}  // namespace

Model load_obj(const std::string& path, const ModelOptions& options) {
  std::string text = read_text_file(path, "OBJ file", max_model_bytes);
  const ObjScan scan = scan_obj(path, text);
  Model model;
  model.files.push_back(source_file(path, text));
  model.not_supported = scan.not_supported;

  tinyobj::attrib_t attrib;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string ignored_warning, error;  // the scan has already said what matters
  const bool replaced = options.materials == ModelMaterials::replaced;
  const bool lenient = options.materials == ModelMaterials::lenient;
  LibraryReader reader(path, lenient, model);
  std::istringstream in(std::move(text));
  constexpr bool triangulate = true, vertex_colors = false;
  const bool loaded = tinyobj::LoadObj(&attrib, &shapes, &materials, &ignored_warning, &error, &in,
                                       replaced ? nullptr : &reader, triangulate, vertex_colors);
  if (!loaded) throw InputError(fmt::format("{}: {}", path, printable(error, 200)));
  const bool strict = options.materials == ModelMaterials::own;
  std::vector<std::string> libraries;
  for (std::size_t i = 1; i < model.files.size(); ++i) libraries.push_back(model.files[i].path);
  if (strict && !shapes.empty()) check_materials(path, scan, libraries, materials);
  const std::vector<bool> with_texture = find_textured(reader.scan(), materials);
  model.not_supported.insert(reader.scan().not_supported.begin(),
                             reader.scan().not_supported.end());
  for (const tinyobj::shape_t& shape : shapes)
    add_parts(shape, attrib, options, with_texture, model);
  if (model.parts.empty()) throw InputError(fmt::format("{}: the file has no faces", path));
  if (strict) check_parts(path, model);
  if (lenient) warn_of_missing(path, scan, model);
  convert_materials(materials, reader.scan(), model);
  return model;
}

}  // namespace pellucid

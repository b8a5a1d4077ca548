// OBJ models: tinyobjloader parses and triangulates, the rest is checks and regrouping.
#include "scene/obj.h"

#include <fmt/format.h>

#include <algorithm>
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

constexpr std::size_t max_model_bytes = std::size_t{8} << 30;
constexpr const char* remedy =
    "; give the file, or give the shape a \"material\", which replaces those of the model";

/// Finds MTL files beside the OBJ file, and fails where tinyobjloader would only warn.
class LibraryReader : public tinyobj::MaterialReader {
 public:
  LibraryReader(std::string obj_path, ObjModel& model)
      : obj_path_(std::move(obj_path)), model_(model) {}

  bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                  std::map<std::string, int>* index, std::string* warn, std::string* err) override {
    const auto path = (std::filesystem::path(obj_path_).parent_path() / name).string();
    std::string text;
    try {
      text = read_text_file(path, "material file", max_model_bytes);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{} (named by '{}'){}", error.what(), obj_path_, remedy));
    }
    scan_mtl(path, text, model_.not_supported);
    model_.files.push_back(path);
    std::istringstream in(text);
    tinyobj::LoadMtl(index, materials, &in, warn, err);
    return true;
  }

 private:
  std::string obj_path_;
  ObjModel& model_;
};

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

/// Collects the triangles of one part, sharing vertices that agree in position and normal.
class PartBuilder {
 public:
  PartBuilder(const tinyobj::attrib_t& attrib, bool smooth) : attrib_(attrib), smooth_(smooth) {}

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

  RawMesh take() { return std::move(mesh_); }

 private:
  static glm::dvec3 read(const std::vector<tinyobj::real_t>& values, int index) {
    const auto at = static_cast<std::size_t>(index) * 3;
    PELLUCID_CHECK(index >= 0 && at + 2 < values.size(), "an OBJ index slipped through the scan");
    return {values[at], values[at + 1], values[at + 2]};
  }

  std::uint32_t vertex(const tinyobj::index_t& corner, glm::dvec3 p, glm::dvec3 flat) {
    const int normal = smooth_ ? corner.normal_index : -1;
    // A corner without a normal in a smooth part takes its face's, so it cannot be shared.
    const bool shared = !smooth_ || normal >= 0;
    const std::uint64_t key = (static_cast<std::uint64_t>(corner.vertex_index) << 32) |
                              static_cast<std::uint32_t>(normal + 1);
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
    if (shared) known_.emplace(key, index);
    return index;
  }

  const tinyobj::attrib_t& attrib_;
  bool smooth_;
  RawMesh mesh_;
  std::unordered_map<std::uint64_t, std::uint32_t> known_;
};

bool has_normals(const tinyobj::mesh_t& mesh) {
  return std::any_of(mesh.indices.begin(), mesh.indices.end(),
                     [](const tinyobj::index_t& i) { return i.normal_index >= 0; });
}

/// One part per material of one tinyobjloader shape, which is an object or a group.
void add_parts(const tinyobj::shape_t& shape, const tinyobj::attrib_t& attrib,
               const ObjOptions& options, ObjModel& model) {
  const bool smooth = options.use_normals && has_normals(shape.mesh);
  std::map<int, PartBuilder> builders;  // by material, in the order of the material file
  for (std::size_t t = 0; t < shape.mesh.num_face_vertices.size(); ++t) {
    const int material = options.ignore_materials ? 0 : shape.mesh.material_ids[t];
    const auto part = builders.try_emplace(material, attrib, smooth).first;
    part->second.add(&shape.mesh.indices[3 * t]);
  }
  for (auto& [material, builder] : builders)
    model.parts.push_back({shape.name, material, std::nullopt, builder.take()});
}

/// Converts the materials in use and renumbers the parts accordingly.
void convert_materials(const std::string& path, const std::vector<tinyobj::material_t>& materials,
                       ObjModel& model) {
  std::map<int, int> renumbered;
  std::vector<std::optional<Emission>> emissions;
  for (ObjPart& part : model.parts) {
    const auto [entry, added] =
        renumbered.emplace(part.material, static_cast<int>(model.materials.size()));
    if (added) {
      if (part.material < 0)
        throw InputError(fmt::format(
            "{}: \"{}\" uses a material before the mtllib that holds it; move mtllib to the top",
            path, printable(part.name)));
      const auto id = static_cast<std::size_t>(part.material);
      MtlSurface surface = convert_mtl(materials[id], model.warnings);
      model.materials.push_back(std::move(surface.material));
      emissions.push_back(surface.emission);
    }
    part.material = entry->second;
    part.emission = emissions[static_cast<std::size_t>(part.material)];
  }
}

}  // namespace

ObjModel load_obj(const std::string& path, const ObjOptions& options) {
  std::string text = read_text_file(path, "OBJ file", max_model_bytes);
  const ObjScan scan = scan_obj(path, text);
  ObjModel model;
  model.files.push_back(path);
  model.not_supported = scan.not_supported;

  tinyobj::attrib_t attrib;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string ignored_warning, error;  // the scan has already said what matters
  LibraryReader reader(path, model);
  std::istringstream in(std::move(text));
  constexpr bool triangulate = true, vertex_colors = false;
  const bool loaded =
      tinyobj::LoadObj(&attrib, &shapes, &materials, &ignored_warning, &error, &in,
                       options.ignore_materials ? nullptr : &reader, triangulate, vertex_colors);
  if (!loaded) throw InputError(fmt::format("{}: {}", path, printable(error, 200)));
  if (!options.ignore_materials && !shapes.empty())
    check_materials(path, scan, {model.files.begin() + 1, model.files.end()}, materials);
  for (const tinyobj::shape_t& shape : shapes) add_parts(shape, attrib, options, model);
  if (model.parts.empty()) throw InputError(fmt::format("{}: the file has no faces", path));
  if (!options.ignore_materials) convert_materials(path, materials, model);
  return model;
}

}  // namespace pellucid

// Models: meshes with or without materials of their own, read from OBJ or PLY.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/mesh_tools.h"
#include "scene/obj_scan.h"
#include "scene/scene.h"

namespace pellucid {

/// Where materials come from.
enum class ModelMaterials {
  own,       ///< the model's; a face without one is an error
  replaced,  ///< the scene gives one for all: those of the model are not read
  lenient,   ///< the model's; a face without one gets no_material
};

struct ModelOptions {
  ModelMaterials materials = ModelMaterials::own;
  bool use_normals = true;  ///< smooth shading where the file has normals
  bool textured = false;    ///< the scene's material has a texture
};

constexpr int no_material = -1;

/// The triangles of one object with one material.
struct ModelPart {
  std::string name;                  ///< of the object or group, may be empty
  int material = 0;                  ///< index into Model::materials, or no_material
  std::optional<Emission> emission;  ///< from Ke
  RawMesh mesh;
};

struct Model {
  std::vector<Material> materials;                  ///< those in use
  std::vector<std::optional<MtlTexture>> textures;  ///< of each material
  std::vector<ModelPart> parts;
  std::vector<SourceFile> files;                     ///< every file read
  std::vector<std::string> warnings;                 ///< oddities of this model
  std::map<std::string, std::string> not_supported;  ///< kind -> the file that asks for it
};

constexpr std::size_t max_model_bytes = std::size_t{8} << 30;

/// Whether the suffix is one of a model, in any case.
bool is_model_file(const std::string& path);

/// Reads by suffix. Throws InputError with file and place for anything that is missing, malformed
/// or out of range.
Model load_model(const std::string& path, const ModelOptions& options);

}  // namespace pellucid

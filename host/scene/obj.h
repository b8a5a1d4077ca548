// OBJ models with their MTL materials, in terms of the scene model.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/mesh_tools.h"
#include "scene/obj_scan.h"
#include "scene/scene.h"

namespace pellucid {

struct ObjOptions {
  bool ignore_materials = false;  ///< the scene gives the material: no MTL file is read
  bool use_normals = true;        ///< smooth shading where the file has normals
  bool textured = false;          ///< the scene's material has a texture
};

/// The triangles of one object with one material.
struct ObjPart {
  std::string name;                  ///< of the object or group, may be empty
  int material = 0;                  ///< index into ObjModel::materials
  std::optional<Emission> emission;  ///< from Ke
  RawMesh mesh;
};

struct ObjModel {
  std::vector<Material> materials;                  ///< those in use
  std::vector<std::optional<MtlTexture>> textures;  ///< of each material
  std::vector<ObjPart> parts;
  std::vector<std::string> files;                    ///< every file read
  std::vector<std::string> warnings;                 ///< oddities of this model
  std::map<std::string, std::string> not_supported;  ///< kind -> the file that asks for it
};

/// Throws InputError with file and line for anything that is missing, malformed or out of range.
ObjModel load_obj(const std::string& path, const ObjOptions& options);

}  // namespace pellucid

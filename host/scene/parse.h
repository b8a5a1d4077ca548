// Parts of the scene parser; load.cpp calls them in order. They append to one Scene.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scene/json_tree.h"
#include "scene/mesh_tools.h"
#include "scene/obj_scan.h"
#include "scene/reader.h"
#include "scene/scene.h"

namespace pellucid {

/// Triangles that wait for the rest of the scene: its bounds tell where coordinates are counted
/// from.
struct UnplacedMesh {
  const JsonNode* node;  ///< of the shape, for messages
  std::size_t shape;     ///< index into Scene::shapes
  RawMesh raw;
  Affine transform;
  bool flip;
};

/// The scene under construction and what is needed to finish it.
struct SceneBuilder {
  Scene scene;
  std::string folder;  ///< of the scene file; assets are relative to it
  std::vector<UnplacedMesh> unplaced;
  std::map<std::string, int> material_index;  ///< of "materials", by name
  std::map<std::string, int> image_index;     ///< of Scene::images, by file and colour space
  std::map<std::string, std::set<std::string>> not_supported;  ///< kind -> files that ask for it
  std::optional<int> bare_material;  ///< of a bare model, where it has none of its own
};

Camera parse_camera(const JsonNode& node);
Light parse_light(const JsonNode& node);
Emission parse_emission(const JsonNode& node);

/// All of "materials". Mixes may name materials that stand after them.
void parse_materials(const JsonNode& node, SceneBuilder& builder);

/// A "texture" of a material: reads its image unless another one did; index into Scene::textures.
int parse_texture(const JsonNode& node, SceneBuilder& builder);
/// The same for a texture of an MTL file.
int add_texture(const MtlTexture& mtl, SceneBuilder& builder);

/// One entry of "shapes"; a mesh may become several shapes.
void parse_shape(const JsonNode& node, SceneBuilder& builder);

/// After all shapes: decides on Scene::origin, and bakes what is unplaced. The nodes of the shapes
/// must still be there.
void place_shapes(SceneBuilder& builder);

/// Index of the material that `name`, a text, names.
int find_material(const JsonNode& name, const SceneBuilder& builder);

}  // namespace pellucid

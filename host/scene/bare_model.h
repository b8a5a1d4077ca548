// A model without a scene: the scene file that it stands for, its camera and its light.
#pragma once

#include <string>

#include "scene/json_tree.h"
#include "scene/parse.h"

namespace pellucid {

/// What the model stands for, but for camera and light: one mesh, one grey material.
JsonNode bare_model_document(const std::string& path);

/// Index of the material for faces that have none; grey, unless an override took its place.
int bare_material(const SceneBuilder& builder);

/// Puts camera and light into the document, from the shapes and the size of the picture; keys that
/// overrides gave stay. Tells both in scene.notes.
void complete_bare_model(Scene& scene, JsonNode& document);

}  // namespace pellucid

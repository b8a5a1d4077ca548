// Reading scenes: by path or by the name of a shipped scene.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/scene.h"

namespace pellucid {

/// Resolves what the user typed: an existing path wins; else the name of a shipped scene, searched
/// as
/// `<folder>/**/<name>.json` in each of `scene_folders`. Throws InputError that lists near names.
std::string find_scene(const std::string& path_or_name,
                       const std::vector<std::string>& scene_folders);

/// Names of all scenes in these folders, sorted.
std::vector<std::string> scene_names(const std::vector<std::string>& scene_folders);

/// What the command line changes about a scene.
struct LoadOptions {
  std::vector<std::string> overrides;       ///< as of apply_override(), in this order
  std::optional<std::pair<int, int>> size;  ///< pixels; wins over the film's
};

/// Loads a native scene (.json, // and /* */ comments allowed) with all its assets, or a model,
/// which gets a camera and, if it is dark, light. Throws InputError with file:line:column, an
/// excerpt, and the valid choices. Unknown keys are errors.
Scene load_scene(const std::string& path, const LoadOptions& options = {});

}  // namespace pellucid

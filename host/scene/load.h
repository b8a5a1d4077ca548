// Reading scenes: by path or by the name of a shipped scene.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace pellucid {

/// Resolves what the user typed: an existing path wins; else the name of a shipped scene, searched
/// as
/// `<folder>/**/<name>.json` in each of `scene_folders`. Throws InputError that lists near names.
std::string find_scene(const std::string& path_or_name,
                       const std::vector<std::string>& scene_folders);

/// Loads a native scene (.json, // and /* */ comments allowed) with all its assets, or throws
/// InputError with file:line:column, an excerpt, and the valid choices. Unknown keys are errors.
Scene load_scene(const std::string& path);

}  // namespace pellucid

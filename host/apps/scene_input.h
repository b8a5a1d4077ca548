// What commands on scenes share: finding and loading them, and choosing the method.
#pragma once

#include <string>

#include "render/integrator.h"
#include "scene/scene.h"

namespace pellucid {

/// Loads a scene by path or shipped name and logs its warnings. Throws InputError.
Scene open_scene(const std::string& path_or_name);

/// The method by flag, else the scene's, else the default. Throws UsageError or InputError that
/// lists the names.
const Integrator& choose_integrator(const std::string& flag, const Scene& scene);

/// Identity of everything the scene was read from.
std::string scene_hash(const Scene& scene);

}  // namespace pellucid

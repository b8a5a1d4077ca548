// What commands on scenes share: finding, loading and packing, with the time each takes.
#pragma once

#include <string>

#include "pack/pack.h"
#include "scene/scene.h"

namespace pellucid {

/// Loads a scene by path or shipped name and logs its warnings. Throws InputError.
Scene open_scene(const std::string& path_or_name);

/// Identity of everything the scene was read from.
std::string scene_hash(const Scene& scene);

}  // namespace pellucid

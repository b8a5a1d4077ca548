// What commands on scenes share: finding and loading them, and choosing the method.
#pragma once

#include <string>
#include <vector>

#include "render/integrator.h"
#include "scene/load.h"

namespace CLI {
class App;
}

namespace pellucid {

/// Declares -D on a command that opens a scene.
void declare_overrides(CLI::App& app, std::vector<std::string>& overrides);

/// Loads a scene or model by path, or a shipped scene by name, and logs its warnings and notes.
/// Throws InputError.
Scene open_scene(const std::string& path_or_name, const LoadOptions& options = {});

/// Names of the shipped scenes, sorted.
std::vector<std::string> shipped_scenes();

/// All methods as "naive|nee|...", the form of a choice in --help.
std::string integrator_names();

/// The method by flag, else the scene's, else the default. Throws UsageError or InputError that
/// lists the names.
const Integrator& choose_integrator(const std::string& flag, const Scene& scene);

/// Identity of everything the scene was read from: its files and the overrides.
std::string scene_hash(const Scene& scene);

}  // namespace pellucid

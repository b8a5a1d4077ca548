// Opening scenes: the source tree's folder or the installed one is searched for shipped names.
#include "apps/scene_input.h"

#include <sys/stat.h>
#include <CLI/App.hpp>

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/text.h"
#include "integrators/registry.h"

namespace pellucid {
namespace {

bool is_folder(const std::string& path) {
  struct stat info;
  return stat(path.c_str(), &info) == 0 && S_ISDIR(info.st_mode);
}

/// Installed: <prefix>/bin/pellucid and <prefix>/share/pellucid/scenes; else the source tree.
std::vector<std::string> scene_folders() {
  const std::string program = executable_path();
  const std::string installed =
      program.substr(0, program.rfind('/') + 1) + "../share/pellucid/scenes";
  return {is_folder(installed) ? installed : PELLUCID_SCENE_DIR};
}

}  // namespace

void declare_overrides(CLI::App& app, std::vector<std::string>& overrides) {
  app.add_option("-D", overrides,
                 "set a value of the scene before it is read, e.g. camera.fov=30, "
                 "shapes.0.material=red or /film/width=64; repeatable")
      ->type_name("POINTER=VALUE")
      ->allow_extra_args(false);
}

std::vector<std::string> shipped_scenes() {
  return scene_names(scene_folders());
}

Scene open_scene(const std::string& path_or_name, const LoadOptions& options) {
  Scene scene = load_scene(find_scene(path_or_name, scene_folders()), options);
  for (const std::string& note : scene.notes) log_info("{}", note);
  for (const std::string& warning : scene.warnings) log_warn("{}", warning);
  return scene;
}

std::string integrator_names() {
  std::vector<std::string> names;
  for (const Integrator& integrator : integrators()) names.push_back(integrator.name);
  return join(names, "|");
}

const Integrator& choose_integrator(const std::string& flag, const Scene& scene) {
  if (!flag.empty()) return find_integrator(flag);
  try {
    return find_integrator(scene.settings.integrator.value_or(default_integrator()));
  } catch (const UsageError& e) {
    throw InputError(scene.path + ": " + e.what());
  }
}

std::string scene_hash(const Scene& scene) {
  Hasher hasher;
  for (const SourceFile& file : scene.files) hasher.add(file.hash);
  for (const std::string& override_text : scene.overrides) hasher.add("\n-D " + override_text);
  return hasher.hex();
}

}  // namespace pellucid

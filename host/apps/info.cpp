// info: what is in a scene, an image or a checkpoint, and what rendering it would take.
#include <CLI/App.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "apps/command.h"
#include "apps/info_parts.h"
#include "apps/outputs.h"
#include "apps/scene_input.h"
#include "image/image.h"

namespace pellucid {
namespace {

bool is_openexr(const std::string& file) {
  constexpr char magic[] = {0x76, 0x2f, 0x31, 0x01};
  char first[sizeof magic] = {};
  std::error_code ignored;  // a pipe can be read only once
  if (!std::filesystem::is_regular_file(file, ignored)) return false;
  std::ifstream(file, std::ios::binary).read(first, sizeof first);
  return std::equal(magic, magic + sizeof magic, first);
}

struct InfoCommand {
  std::string file;
  std::vector<std::string> overrides;
  DeviceFlags device;

  /// By content for OpenEXR, which a checkpoint is whatever its name, else by name. A new kind of
  /// file gets a line here and a function in info_parts.h.
  ExitCode run(const CommonOptions& common) const {
    device.limit();
    const bool openexr = is_openexr(file), image = openexr || is_picture_name(file);
    if (image && !overrides.empty())
      throw UsageError("-D changes scenes; '" + file + "' is an image");
    if (openexr && holds_words(file)) return checkpoint_info(file, common);
    if (image) return image_info(file, common);
    return scene_info(file, {overrides, {}}, device, common);
  }
};

}  // namespace

CommandRun setup_info(CLI::App& app) {
  auto c = std::make_shared<InfoCommand>();
  app.add_option("FILE", c->file,
                 "a scene, a model, the name of a shipped scene, an image or a checkpoint")
      ->required();
  declare_overrides(app, c->overrides);
  c->device.declare(app);
  c->device.declare_threads(app);
  app.footer("Example: pellucid info cornell-box");
  return [c](const CommonOptions& common) { return c->run(common); };
}

}  // namespace pellucid

// info: what is in a scene or an image, and what rendering it would take.
#include "apps/command.h"
#include "apps/info_parts.h"
#include "apps/outputs.h"
#include "apps/scene_input.h"

namespace pellucid {
namespace {

struct InfoCommand {
  std::string file;
  std::vector<std::string> overrides;
  DeviceFlags device;

  /// By what the name looks like: a new kind of file (a checkpoint) gets a line here and a function
  /// in info_parts.h.
  ExitCode run(const CommonOptions& common) const {
    device.limit();
    if (is_picture_name(file)) {
      if (!overrides.empty()) throw UsageError("-D changes scenes; '" + file + "' is an image");
      return image_info(file, common);
    }
    return scene_info(file, {overrides, {}}, device, common);
  }
};

}  // namespace

CommandRun setup_info(CLI::App& app) {
  auto c = std::make_shared<InfoCommand>();
  app.add_option("FILE", c->file, "a scene, a model, the name of a shipped scene, or an image")
      ->required();
  declare_overrides(app, c->overrides);
  c->device.declare(app);
  c->device.declare_threads(app);
  app.footer("Example: pellucid info cornell-box");
  return [c](const CommonOptions& common) { return c->run(common); };
}

}  // namespace pellucid

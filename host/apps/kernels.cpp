// kernels: the specialised programs of a scene and method, to read or to keep.
#include <fmt/format.h>
#include <CLI/App.hpp>

#include <nlohmann/json.hpp>

#include <filesystem>

#include "apps/command.h"
#include "apps/common.h"
#include "apps/device_input.h"
#include "apps/scene_input.h"
#include "base/files.h"
#include "render/plan.h"

namespace pellucid {
namespace {

struct KernelsCommand {
  std::string scene, integrator, features = "auto", kernel_dir, dump;
  std::vector<std::string> overrides;
  DeviceFlags device;

  ExitCode run(const CommonOptions& common) const;
};

ExitCode KernelsCommand::run(const CommonOptions& common) const {
  const Scene s = open_scene(scene, {overrides, {}});
  const Integrator& method = choose_integrator(integrator, s);
  PlanOptions options;
  options.extra_features = parse_feature_request(features);
  const Device target = device.open();
  const PackedScene packed = pack_scene(s, {simd_width_for(target.info())});
  const Specialisation special = specialise(packed, method, target.info(), options);
  const std::string prelude = prelude_of(special), build_options = options_of(special);
  const KernelFiles files(kernel_dir);
  if (!dump.empty()) {
    std::error_code error;
    std::filesystem::create_directories(dump, error);
    if (error)
      throw OutputError(fmt::format("{}: cannot make the folder: {}", dump, error.message()));
  }
  std::string text =
      fmt::format("for {} by {} on {}\nfeatures  {}\noptions   {}\n", s.name, method.name,
                  target.info().name, special.features.describe(), build_options);
  nlohmann::json kernels = nlohmann::json::array();
  for (const std::string& kernel : method.kernels()) {
    const std::string source = files.expand("passes/" + kernel + ".cl", prelude);
    const std::string file = dump.empty() ? "" : dump + "/" + kernel + ".cl";
    if (!dump.empty()) {
      write_text_atomic(file, source);
      write_text_atomic(dump + "/" + kernel + ".options", build_options + "\n");
    }
    const auto lines = std::count(source.begin(), source.end(), '\n');
    text += fmt::format("{:<10}{} lines{}\n", kernel, lines,
                        file.empty() ? "" : ", written to " + file);
    kernels.push_back({{"name", kernel}, {"lines", lines}, {"file", file}});
  }
  if (common.wants_text()) print_result(text);
  write_json(common.json, {{"scene", s.name},
                           {"integrator", method.name},
                           {"options", build_options},
                           {"prelude", prelude},
                           {"kernels", kernels}});
  return ExitCode::done;
}

}  // namespace

CommandRun setup_kernels(CLI::App& app) {
  auto c = std::make_shared<KernelsCommand>();
  app.add_option("SCENE", c->scene, "scene file, model, or the name of a shipped scene")
      ->required();
  declare_overrides(app, c->overrides);
  app.add_option("-i,--integrator", c->integrator, "method (default: the scene's, else path)")
      ->type_name(integrator_names());
  c->device.declare(app);
  app.add_option("--features", c->features, "auto, all, or a list like +phong,+disks")
      ->type_name("auto|all|LIST");
  app.add_option("--kernel-dir", c->kernel_dir, "read kernels from this folder")->type_name("DIR");
  app.add_option("--dump", c->dump,
                 "write each program's exact source and options into this folder")
      ->type_name("DIR");
  app.footer("Example: pellucid kernels cornell-box -i path --dump /tmp/kernels");
  return [c](const CommonOptions& common) { return c->run(common); };
}

}  // namespace pellucid

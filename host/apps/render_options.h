// The command line of `render`: every option, and what it means for a scene and a method.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/device_input.h"
#include "apps/outputs.h"
#include "render/session.h"
#include "scene/load.h"

namespace CLI {
class App;
}

namespace pellucid {

/// Everything that --aov takes: the film's own channels, its layers, then what the AOV pass makes.
std::vector<std::string> aov_names();

/// Values of --radius and --radius-alpha. Throw UsageError out of range.
double parse_radius(const std::string& text);
double parse_radius_alpha(const std::string& text);

/// Options as people write them. Precedence: flag, environment, scene, default.
struct RenderFlags {
  std::string scene, integrator, mis = "balance", sampler = "sobol", filter, time, error, size,
                                 crop, passes, features = "auto", float_mode = "strict", kernel_dir,
                                 stats, memory, checkpoint, every, vertices, radius, radius_alpha,
                                 merges, atlas, grid, replay;
  std::vector<std::string> overrides, outputs, aovs;
  DeviceFlags device;
  DisplayFlags display;
  std::uint64_t spp = 0, seed = 0, max_depth = 0, group = 0, light_paths = 0;
  std::uint64_t aov_length = 0;  ///< 0: not given
  std::uint64_t fireflies = 0;
  bool strict = false, deterministic = false, resume = false, dry_run = false;

  void declare(CLI::App& app);
  /// Throws UsageError for a value that no scene could make sense of.
  void check() const;
  LoadOptions load_options() const;
  /// The scene's settings as the flags want them. Throws UsageError.
  void override_settings(RenderSettings& settings) const;
  /// The method that flag, scene or default name. Throws UsageError.
  const Integrator& plain_method(const Scene& s) const;
  /// The same with the layers that --aov, --atlas and --grid need. Throws UsageError.
  Integrator method(const Scene& s) const;
  /// What the session is told. Throws UsageError.
  RenderOptions options(const Scene& scene, const Integrator& method) const;
  /// Seconds between two checkpoints.
  double checkpoint_period() const;
  /// Pictures to write; the default ones are named after the scene.
  std::vector<std::string> output_names(const Scene& scene) const;
  /// These pictures and what is drawn of layers, for reports.
  std::vector<std::string> results(std::vector<std::string> pictures) const;

 private:
  void declare_files(CLI::App& app);     ///< pictures
  void declare_progress(CLI::App& app);  ///< checkpoints and ranges of passes
  uint layer_kinds() const;              ///< LAYERS_* that are asked for
  void check_replay() const;
};

}  // namespace pellucid

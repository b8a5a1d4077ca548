// `bench --only render`: the fixed workloads by every method, on one device or all.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace pellucid {

struct DeviceFlags;

class RenderBench {
 public:
  /// `names`: scenes instead of the workload's, if any. Throws InputError.
  RenderBench(const std::vector<std::string>& names, std::optional<int> repeats,
              std::string kernel_dir);

  /// Name -> hash of what will be rendered.
  const nlohmann::json& scenes() const { return hashes_; }

  /// On the device that is named, else on every usable one in turns. What fails on one is told in
  /// the document. Throws DeviceError if the device named, or every one, fails at once.
  nlohmann::json run(const DeviceFlags& device) const;

 private:
  nlohmann::json run_on(const std::string& spec, const DeviceFlags& flags) const;

  bool whole_;  ///< all workloads, so that there are scores
  std::vector<Scene> scenes_;
  nlohmann::json hashes_;
  std::optional<int> repeats_;
  std::string kernel_dir_;
};

/// What is rendered and what a score means, for --help.
std::string render_bench_help();

}  // namespace pellucid

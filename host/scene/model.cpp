// Models by suffix.
#include "scene/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "scene/obj.h"
#include "scene/ply.h"
#include "scene/text_file.h"

namespace pellucid {
namespace {

std::string lower_suffix(const std::string& path) {
  std::string suffix = std::filesystem::path(path).extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return suffix;
}

}  // namespace

bool is_model_file(const std::string& path) {
  const std::string suffix = lower_suffix(path);
  return suffix == ".obj" || suffix == ".ply";
}

Model load_model(const std::string& path, const ModelOptions& options) {
  const std::string suffix = lower_suffix(path);
  if (suffix == ".obj") return load_obj(path, options);
  if (suffix == ".ply") return load_ply(path, options);
  throw InputError(
      fmt::format("'{}': models are read from .obj and .ply files", printable(path, 1000)));
}

}  // namespace pellucid

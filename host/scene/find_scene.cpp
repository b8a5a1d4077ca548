// From what the user typed to the scene file that is meant.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "base/text.h"
#include "scene/load.h"
#include "scene/text_file.h"

namespace pellucid {
namespace fs = std::filesystem;
namespace {

/// All scene files under the folder, in an order that does not depend on the file system.
std::vector<fs::path> scene_files(const std::string& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  const auto options = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator it(folder, options, ignored), end; !ignored && it != end;
       it.increment(ignored))
    if (it->path().extension() == ".json") files.push_back(it->path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::vector<std::string> scene_names(const std::vector<std::string>& scene_folders) {
  std::vector<std::string> names;
  for (const std::string& folder : scene_folders)
    for (const fs::path& file : scene_files(folder)) names.push_back(file.stem().string());
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::string find_scene(const std::string& path_or_name,
                       const std::vector<std::string>& scene_folders) {
  std::error_code ignored;
  // A link that leads nowhere exists, too: the loader tells what is wrong with it.
  const bool exists = fs::exists(fs::symlink_status(path_or_name, ignored));
  // A folder named like a shipped scene does not hide it; any other is left to the loader's
  // message.
  if (exists && !fs::is_directory(path_or_name, ignored)) return path_or_name;
  for (const std::string& folder : scene_folders)
    for (const fs::path& file : scene_files(folder))
      if (file.stem() == path_or_name || file.filename() == path_or_name) return file.string();
  if (exists) return path_or_name;
  const std::vector<std::string> names = scene_names(scene_folders);
  const std::string shipped =
      names.empty() ? fmt::format("no shipped scenes were found in {}", list_choices(scene_folders))
                    : "shipped scenes: " + fmt::format("{}", fmt::join(names, ", "));
  throw InputError(fmt::format("there is neither a file nor a shipped scene '{}'.{}\n{}",
                               printable(path_or_name),
                               did_you_mean(printable(path_or_name), names), shipped));
}

}  // namespace pellucid

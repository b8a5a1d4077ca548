// Shared by the tests of the scene module: files that vanish with the test, and minimal scenes.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/error.h"
#include "scene/load.h"

namespace pellucid::test {

/// A folder of its own that is removed at the end of the scope.
class TempFolder {
 public:
  TempFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "pellucid-XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  std::string write(const std::string& name, const std::string& text) const {
    // A new file instead of a truncated one, which some file systems write to the disk at once.
    std::filesystem::remove(path_ / name);
    std::ofstream(path_ / name, std::ios::binary) << text;
    return (path_ / name).string();
  }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

inline Scene load_text(const std::string& text) {
  const TempFolder folder;
  return load_scene(folder.write("scene.json", text));
}

/// A valid scene with the given text in place of parts; each part keeps its default where empty.
inline std::string scene_with(const std::string& shapes, const std::string& lights = "",
                              const std::string& materials = "") {
  return R"({"version": 1, "camera": {"origin": [0, 0, 5], "target": [0, 0, 0]},
  "materials": {"m": {"type": "diffuse"})" +
         (materials.empty() ? "" : ", " + materials) + "},\n  \"shapes\": [" + shapes +
         "],\n  \"lights\": [" + lights + "]}";
}

/// The message of the InputError that `run` throws; "" if it throws none.
template <class Run>
std::string input_error(Run run) {
  try {
    run();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

inline std::string load_error(const std::string& text) {
  return input_error([&] { load_text(text); });
}

}  // namespace pellucid::test

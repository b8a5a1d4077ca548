// Files that vanish with their scope.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>

namespace pellucid::stability {

struct TemporaryFile {
  explicit TemporaryFile(const char* suffix)
      : path((std::filesystem::temp_directory_path() /
              fmt::format("pellucid-stability-{}{}", getpid(), suffix))
                 .string()) {}
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string path;
};

}  // namespace pellucid::stability

// From kernel files to one self-contained source text.
#pragma once

#include <string>
#include <vector>

namespace pellucid {

/// Kernel files: those inside the binary, or a folder on disk for live work (--kernel-dir).
class KernelFiles {
 public:
  /// `overlay`: a folder below kernels/ whose files stand in for those of the same name.
  explicit KernelFiles(std::string folder = "", std::string overlay = "")
      : folder_(std::move(folder)), overlay_(std::move(overlay)) {}

  /// Text of `name` (path below kernels/). Throws InputError if there is none.
  std::string read(const std::string& name) const;

  /// `name` with every #include "..." resolved once, #line markers kept, and `prelude` in front.
  /// Throws InputError naming file and line of an include that cannot be found.
  std::string expand(const std::string& name, const std::string& prelude) const;

 private:
  bool has(const std::string& name) const;

  std::string folder_, overlay_;
};

}  // namespace pellucid

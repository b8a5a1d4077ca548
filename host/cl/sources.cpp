// Include expansion for kernels: device compilers get one text and need no include path.
#include "cl/sources.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "base/error.h"
#include "base/files.h"
#include "cl/embedded_sources.h"

namespace pellucid {
namespace {

/// The quoted name of an #include line, or "".
std::string included_name(const std::string& line) {
  const size_t hash = line.find_first_not_of(" \t");
  if (hash == std::string::npos || line.compare(hash, 8, "#include") != 0) return "";
  const size_t open = line.find('"', hash), close = line.find('"', open + 1);
  if (open == std::string::npos || close == std::string::npos) return "";
  return line.substr(open + 1, close - open - 1);
}

const cl_detail::EmbeddedFile* embedded(const std::string& name) {
  for (unsigned i = 0; i < cl_detail::embedded_file_count; ++i)
    if (name == cl_detail::embedded_files[i].name) return &cl_detail::embedded_files[i];
  return nullptr;
}

struct Expander {
  const KernelFiles& files;
  std::set<std::string> done;
  std::string out;

  void add(const std::string& name, const std::string& from) {
    if (!done.insert(name).second) return;
    std::string text;
    try {
      text = files.read(name);
    } catch (const InputError& e) {
      throw InputError(from.empty() ? std::string(e.what())
                                    : fmt::format("{}: {}", from, e.what()));
    }
    std::istringstream stream(text);
    out += fmt::format("#line 1 \"{}\"\n", name);
    std::string line;
    for (int number = 1; std::getline(stream, line); ++number) {
      const std::string included = included_name(line);
      // Branches of the host's compiler (core/real_host.h) stay behind their #if.
      if (included.empty() || included == "core/real_host.h") {
        out += (included.empty() ? line : "") + "\n";
        continue;
      }
      add(included, fmt::format("{}:{}", name, number));
      out += fmt::format("#line {} \"{}\"\n", number + 1, name);
    }
  }
};

}  // namespace

bool KernelFiles::has(const std::string& name) const {
  return folder_.empty() ? embedded(name) != nullptr
                         : std::filesystem::exists(folder_ + "/" + name);
}

std::string KernelFiles::read(const std::string& asked) const {
  const std::string stand_in = overlay_ + "/" + asked;
  const std::string& name = !overlay_.empty() && has(stand_in) ? stand_in : asked;
  if (!folder_.empty()) return read_text(folder_ + "/" + name);
  if (const auto* file = embedded(name)) return std::string(file->text, file->size);
  throw InputError(fmt::format("there is no kernel file '{}'", name));
}

std::string KernelFiles::expand(const std::string& name, const std::string& prelude) const {
  Expander expander{*this, {}, prelude};
  expander.add(name, "");
  return expander.out;
}

}  // namespace pellucid

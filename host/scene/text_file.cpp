// Reading text files with clear errors, and user text in messages.
#include "scene/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "base/hash.h"
#include "base/text.h"

namespace pellucid {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> sibling_names(const fs::path& path) {
  std::vector<std::string> names;
  std::error_code ignored;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  for (fs::directory_iterator it(folder, ignored), end; !ignored && it != end;
       it.increment(ignored))
    names.push_back(it->path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::uintmax_t check_file(const std::string& path, const std::string& role, std::size_t max_bytes) {
  const std::string shown = printable(path, 1000);
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (code && status.type() != fs::file_type::not_found)  // a loop of links, a closed folder
    throw InputError(fmt::format("{} '{}' cannot be read: {}", role, shown, code.message()));
  if (!fs::exists(status))
    throw InputError(
        fmt::format("{} '{}' does not exist.{}", role, shown,
                    did_you_mean(fs::path(path).filename().string(), sibling_names(path))));
  if (fs::is_directory(status))
    throw InputError(fmt::format("{} '{}' is a folder; name a file in it", role, shown));
  // Pipes and devices may never end, and can be read only once; the scene's hash reads again.
  if (!fs::is_regular_file(status))
    throw InputError(fmt::format("{} '{}' is a pipe or a device; copy it to a file", role, shown));
  const std::uintmax_t size = fs::file_size(path, code);
  if (!code && size > max_bytes)
    throw InputError(fmt::format("{} '{}' has {} bytes, more than the limit of {} bytes", role,
                                 shown, size, max_bytes));
  return code ? 0 : size;
}

std::string read_text_file(const std::string& path, const std::string& role,
                           std::size_t max_bytes) {
  const std::string shown = printable(path, 1000);
  const std::uintmax_t size = check_file(path, role, max_bytes);
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw InputError(fmt::format("{} '{}' cannot be read: {}", role, shown, std::strerror(errno)));
  std::string text;
  text.reserve(static_cast<std::size_t>(size));
  char block[65536];
  // Some files of the system tell no size in advance, so the limit is kept while reading, too.
  while (in.read(block, sizeof block) || in.gcount() > 0) {
    text.append(block, static_cast<std::size_t>(in.gcount()));
    if (text.size() > max_bytes)
      throw InputError(
          fmt::format("{} '{}' is larger than the limit of {} bytes", role, shown, max_bytes));
  }
  if (in.bad()) throw InputError(fmt::format("{} '{}': reading failed", role, shown));
  while (text.compare(0, 3, "\xEF\xBB\xBF") == 0) text.erase(0, 3);
  return text;
}

SourceFile source_file(const std::string& path, const std::string& text) {
  return {path, hash_hex(text)};
}

std::string list_choices(const std::vector<std::string>& choices) {
  constexpr std::size_t most = 40;  // a scene may have a million materials
  std::string text;
  for (std::size_t i = 0; i < std::min(choices.size(), most); ++i) {
    if (i > 0) text += i + 1 == choices.size() ? " or " : ", ";
    text += '"' + printable(choices[i]) + '"';
  }
  if (choices.size() > most) text += fmt::format(" and {} more", choices.size() - most);
  return text;
}

std::string printable(const std::string& text, std::size_t max_length) {
  std::string result = text.substr(0, max_length);
  for (char& c : result)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  if (text.size() > max_length) result += "...";
  return result;
}

}  // namespace pellucid

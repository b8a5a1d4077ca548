// Reading text files with clear errors, and user text in messages.
#include "scene/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "base/error.h"
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
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (!fs::exists(status))
    throw InputError(
        fmt::format("{} '{}' does not exist.{}", role, path,
                    did_you_mean(fs::path(path).filename().string(), sibling_names(path))));
  if (fs::is_directory(status))
    throw InputError(fmt::format("{} '{}' is a folder; name a file in it", role, path));
  const std::uintmax_t size = fs::is_regular_file(status) ? fs::file_size(path, code) : 0;
  if (!code && size > max_bytes)
    throw InputError(fmt::format("{} '{}' has {} bytes, more than the limit of {} bytes", role,
                                 path, size, max_bytes));
  return code ? 0 : size;
}

std::string read_text_file(const std::string& path, const std::string& role,
                           std::size_t max_bytes) {
  const std::uintmax_t size = check_file(path, role, max_bytes);
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw InputError(fmt::format("{} '{}' cannot be read: {}", role, path, std::strerror(errno)));
  std::string text;
  text.reserve(static_cast<std::size_t>(size));
  char block[65536];
  // Special files tell no size in advance, so the limit is kept while reading, too.
  while (in.read(block, sizeof block) || in.gcount() > 0) {
    text.append(block, static_cast<std::size_t>(in.gcount()));
    if (text.size() > max_bytes)
      throw InputError(
          fmt::format("{} '{}' is larger than the limit of {} bytes", role, path, max_bytes));
  }
  if (in.bad()) throw InputError(fmt::format("{} '{}': reading failed", role, path));
  if (text.compare(0, 3, "\xEF\xBB\xBF") == 0) text.erase(0, 3);
  return text;
}

std::string list_choices(const std::vector<std::string>& choices) {
  std::string text;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (i > 0) text += i + 1 == choices.size() ? " or " : ", ";
    text += '"' + printable(choices[i]) + '"';
  }
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

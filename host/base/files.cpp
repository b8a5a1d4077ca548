// Atomic files with plain system calls: every failure has an errno worth telling.
#include "base/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <system_error>
#include <utility>

#include "base/error.h"

namespace pellucid {
namespace {

std::string resolve_links(const std::string& path) {
  std::unique_ptr<char, decltype(&std::free)> real(realpath(path.c_str(), nullptr), &std::free);
  return real ? real.get() : path;  // does not exist yet, or a link to nothing: take it as it is
}

/// Hidden, short whatever the length of the name, unique among processes and threads, and with the
/// suffix of the target, since image libraries choose the format by it.
std::string temporary_name(const std::string& target) {
  static std::atomic<unsigned> counter{0};
  const std::filesystem::path path(target);
  const std::string name =
      fmt::format(".pellucid-{}-{}{}", getpid(), counter++, path.extension().string());
  return (path.parent_path() / name).string();
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(path), target_(resolve_links(path)) {
  if (path.empty()) throw OutputError("cannot write a file without a name");
  struct stat info;
  const bool exists = stat(target_.c_str(), &info) == 0;
  if (exists && S_ISDIR(info.st_mode)) fail(EISDIR);
  // A file made read-only is meant to stay, though rename() would not mind.
  if (exists && access(target_.c_str(), W_OK) != 0) fail(errno);
  const bool in_place = exists && !S_ISREG(info.st_mode);
  temporary_ = in_place ? target_ : temporary_name(target_);
  const int flags = O_WRONLY | O_CLOEXEC | (in_place ? 0 : O_CREAT | O_EXCL);
  // No destructor runs if this throws, and none has to: nothing was created.
  descriptor_ = open(temporary_.c_str(), flags, 0666);
  if (descriptor_ < 0) fail(errno);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) close(descriptor_);
  if (!done_ && temporary_ != target_) unlink(temporary_.c_str());
}

void AtomicFile::write(const void* data, std::size_t bytes) {
  const char* next = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t written = ::write(descriptor_, next, bytes);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    next += written;
    bytes -= static_cast<std::size_t>(written);
  }
}

void AtomicFile::commit() {
  const int status = close(std::exchange(descriptor_, -1));
  if (status != 0) fail(errno);  // where network file systems report a full disk
  const bool in_place = temporary_ == target_;
  if (!in_place && std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  done_ = true;
}

void AtomicFile::fail(int error) const {
  throw OutputError(fmt::format("cannot write '{}': {}", path_, system_reason(error)));
}

bool same_file(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code ignored;
  const auto whole = [&](const std::string& name) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(name), ignored);
  };
  const bool device = std::filesystem::exists(a, ignored) &&
                      !std::filesystem::is_regular_file(a, ignored);  // /dev/null takes all
  return !device && (std::filesystem::equivalent(a, b, ignored) || whole(a) == whole(b));
}

void check_writable(const std::string& path) {
  struct stat info;
  const bool exists = stat(path.c_str(), &info) == 0;
  if (exists && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode)) return;
  const AtomicFile trial(path);
}

void write_text_atomic(const std::string& path, std::string_view text) {
  AtomicFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

std::string read_text(const std::string& path) {
  const auto fail = [&](int error) {
    throw InputError(fmt::format("cannot read '{}': {}", path, system_reason(error)));
  };
  struct stat info;
  if (stat(path.c_str(), &info) != 0) fail(errno);
  if (S_ISDIR(info.st_mode)) fail(EISDIR);  // fopen() of a folder would succeed
  if (!S_ISREG(info.st_mode))               // may never end
    throw InputError(
        fmt::format("cannot read '{}': it is a pipe or a device; copy it to a file", path));
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail(errno);
  std::ostringstream text;
  text << stream.rdbuf();
  if (stream.bad()) fail(errno);
  return text.str();
}

std::string executable_path() {
  std::error_code error;
  const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? "" : path.string();
}

std::string system_reason(int error) {
  return std::generic_category().message(error);
}

}  // namespace pellucid

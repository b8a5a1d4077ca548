// Files that appear whole or not at all, and where our own executable lies.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pellucid {

/// A file written under a temporary name in the folder of `path` and renamed by commit(); without
/// commit() the destructor removes it and what `path` held before is untouched. A symbolic link is
/// followed, so it stays a link. What is no regular file (/dev/null, a pipe) is written in place.
/// Every failure is an OutputError that names `path` and the system's reason.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* data, std::size_t bytes);
  void commit();

  /// For libraries that insist on opening a file themselves: exists, is empty, has the suffix of
  /// `path`. Write either here or through write().
  const std::string& temporary() const { return temporary_; }

 private:
  [[noreturn]] void fail(int error) const;

  std::string path_;       ///< as the user gave it, for messages
  std::string target_;     ///< links resolved
  std::string temporary_;  ///< target_ itself if that is no regular file
  int descriptor_ = -1;
  bool done_ = false;
};

/// Whether both names lead to one file, or would once they are written.
bool same_file(const std::string& a, const std::string& b);

/// Whether `path` could be written now, found out by trying: throws the OutputError that writing
/// would, and leaves nothing behind. Pipes and devices are not touched.
void check_writable(const std::string& path);

/// Throws OutputError; `path` is always a file name ("-" is not standard output here).
void write_text_atomic(const std::string& path, std::string_view text);

/// Whole regular file as bytes. Throws InputError with path and reason.
std::string read_text(const std::string& path);

/// Absolute path of the running program, links resolved; "" if the system does not tell.
std::string executable_path();

/// strerror, safe in threads.
std::string system_reason(int error);

}  // namespace pellucid

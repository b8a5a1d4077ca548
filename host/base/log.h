// The log and the progress line, which share stderr. stdout belongs to results.
#pragma once

#include <fmt/core.h>

#include <string>
#include <string_view>

namespace pellucid {

/// quiet: warnings and errors only, no progress. verbose: also log_verbose().
enum class LogLevel { quiet, normal, verbose };

void set_log_level(LogLevel level);
LogLevel log_level();

namespace log_detail {
enum class Kind { error, warning, info, verbose };
void print(Kind kind, fmt::string_view format, fmt::format_args args);
}  // namespace log_detail

/// One line each on stderr; coloured only on a terminal without NO_COLOR; any thread may call them.
template <typename... T>
void log_error(fmt::format_string<T...> format, T&&... args) {
  log_detail::print(log_detail::Kind::error, format, fmt::make_format_args(args...));
}
template <typename... T>
void log_warn(fmt::format_string<T...> format, T&&... args) {
  log_detail::print(log_detail::Kind::warning, format, fmt::make_format_args(args...));
}
template <typename... T>
void log_info(fmt::format_string<T...> format, T&&... args) {
  log_detail::print(log_detail::Kind::info, format, fmt::make_format_args(args...));
}
template <typename... T>
void log_verbose(fmt::format_string<T...> format, T&&... args) {
  log_detail::print(log_detail::Kind::verbose, format, fmt::make_format_args(args...));
}

/// A phase that takes time, shown as "name elapsed  text". A thread of its own paints it, so the
/// clock runs on even while the caller is stuck inside a driver: on a terminal one line redrawn
/// four times a second and fitted to the width, elsewhere a plain line every 10 s. It vanishes on a
/// terminal when the object dies. One shows at a time: while one lives, others stay silent.
class Progress {
 public:
  explicit Progress(std::string name);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Cheap: only stores the text. Elapsed time is shown anyway and need not be part of it.
  void update(std::string text);

 private:
  bool active_ = false;
};

/// The first `columns` characters of UTF-8 text, "..." at the end if something had to go.
std::string fit_line(std::string_view text, int columns);

}  // namespace pellucid

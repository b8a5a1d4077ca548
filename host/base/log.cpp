// One mutex guards stderr: a log line first wipes the progress line, then draws it again.
#include "base/log.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <thread>

#include "base/text.h"
#include "base/timer.h"

namespace pellucid {
namespace {

constexpr auto TERMINAL_PERIOD = std::chrono::milliseconds(250);
constexpr auto PLAIN_PERIOD = std::chrono::seconds(10);
constexpr int DEFAULT_COLUMNS = 80;  // when a terminal does not tell its width
constexpr const char* WIPE = "\r\x1b[2K";

std::atomic<LogLevel> level{LogLevel::normal};

/// Everything about the phase on show; guarded by `mutex`.
struct Sink {
  std::mutex mutex;
  std::condition_variable wake;
  std::thread painter;
  bool busy = false;      // a Progress lives
  bool ending = false;    // and its painter has to end
  bool terminal = false;  // where it is painted
  std::string name, text;
  std::string painted;  // the line that stands on the terminal now
  Timer timer;
};

Sink& sink() {
  static Sink instance;
  return instance;
}

/// stderr is unbuffered, so one call is one write and lines of several processes do not mix.
void put(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
}

bool stderr_is_terminal() {
  const char* term = std::getenv("TERM");
  return isatty(STDERR_FILENO) != 0 && !(term && std::string_view(term) == "dumb");
}

bool coloured() {
  const char* no_color = std::getenv("NO_COLOR");  // set and not empty: see no-color.org
  return stderr_is_terminal() && !(no_color && *no_color);
}

int terminal_columns() {
  winsize size = {};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : DEFAULT_COLUMNS;
}

void paint(Sink& s) {
  std::string line = s.name + ' ' + format_seconds(s.timer.seconds());
  if (!s.text.empty()) line += "  " + s.text;
  if (!s.terminal) return put(line + '\n');
  s.painted = fit_line(line, terminal_columns() - 1);  // a full last column would wrap
  put(WIPE + s.painted);
}

void paint_until_end() {
  Sink& s = sink();
  std::unique_lock<std::mutex> lock(s.mutex);
  const std::chrono::milliseconds period = s.terminal ? TERMINAL_PERIOD : PLAIN_PERIOD;
  auto next = std::chrono::steady_clock::now() + period;
  while (!s.wake.wait_until(lock, next, [&] { return s.ending; })) {
    paint(s);
    next = std::chrono::steady_clock::now() + period;
  }
}

}  // namespace

void set_log_level(LogLevel new_level) {
  level = new_level;
}
LogLevel log_level() {
  return level;
}

void log_detail::print(Kind kind, fmt::string_view format, fmt::format_args args) {
  if (kind == Kind::info && level == LogLevel::quiet) return;
  if (kind == Kind::verbose && level != LogLevel::verbose) return;
  std::string prefix;
  if (kind == Kind::error) prefix = coloured() ? "\x1b[1;31merror:\x1b[0m " : "error: ";
  if (kind == Kind::warning) prefix = coloured() ? "\x1b[1;33mwarning:\x1b[0m " : "warning: ";
  const std::string line = "pellucid: " + prefix + fmt::vformat(format, args) + '\n';

  Sink& s = sink();
  const std::lock_guard<std::mutex> lock(s.mutex);
  put(s.painted.empty() ? line : WIPE + line + s.painted);
}

Progress::Progress(std::string name) {
  if (level == LogLevel::quiet) return;
  Sink& s = sink();
  const std::lock_guard<std::mutex> lock(s.mutex);
  if (s.busy) return;
  active_ = s.busy = true;
  s.ending = false;
  s.terminal = stderr_is_terminal();
  s.name = std::move(name);
  s.text.clear();
  s.timer.restart();
  s.painter = std::thread(paint_until_end);
}

Progress::~Progress() {
  if (!active_) return;
  Sink& s = sink();
  {
    const std::lock_guard<std::mutex> lock(s.mutex);
    s.ending = true;
  }
  s.wake.notify_all();
  s.painter.join();
  const std::lock_guard<std::mutex> lock(s.mutex);
  if (!s.painted.empty()) put(WIPE);
  s.painted.clear();
  s.busy = false;
}

void Progress::update(std::string text) {
  if (!active_) return;
  Sink& s = sink();
  const std::lock_guard<std::mutex> lock(s.mutex);
  s.text = std::move(text);
}

std::string fit_line(std::string_view text, int columns) {
  const auto starts_character = [](char c) { return (c & 0xC0) != 0x80; };  // UTF-8
  if (columns < 3) return std::string(static_cast<std::size_t>(columns > 0 ? columns : 0), '.');
  int count = 0;
  std::size_t cut = 0;  // where the text ends if "..." has to follow
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!starts_character(text[i])) continue;
    if (count == columns - 3) cut = i;
    if (++count > columns) return std::string(text.substr(0, cut)) + "...";
  }
  return std::string(text);
}

}  // namespace pellucid

// The log and the progress line on a terminal (a pseudo one) and elsewhere (a pipe).
#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "base/log.h"

namespace pellucid {
namespace {

/// Sends stderr into a pipe or a pseudo-terminal of 30 columns while it lives.
class Capture {
 public:
  explicit Capture(bool terminal) : saved_(dup(STDERR_FILENO)) {
    int ends[2];
    winsize size = {};
    size.ws_col = 30;
    size.ws_row = 10;
    const int status = terminal ? openpty(&ends[0], &ends[1], nullptr, nullptr, &size) : pipe(ends);
    EXPECT_EQ(status, 0);
    read_ = ends[0];
    dup2(ends[1], STDERR_FILENO);
    close(ends[1]);
    setenv("TERM", "xterm", 1);
  }
  ~Capture() { text(); }
  /// Everything written so far; ends the capture.
  std::string text() {
    if (saved_ < 0) return text_;
    dup2(saved_, STDERR_FILENO);  // the last writer is gone: reading ends
    close(saved_);
    saved_ = -1;
    char buffer[4096];
    for (ssize_t n; (n = read(read_, buffer, sizeof buffer)) > 0;)
      text_.append(buffer, std::size_t(n));
    close(read_);
    return text_;
  }

 private:
  int saved_, read_ = -1;
  std::string text_;
};

class Log : public ::testing::Test {
 protected:
  void SetUp() override { unsetenv("NO_COLOR"); }
  void TearDown() override { set_log_level(LogLevel::normal); }
};

void log_all() {
  log_error("e{}", 1);
  log_warn("w{}", 2);
  log_info("i{}", 3);
  log_verbose("v{}", 4);
}

std::string logged(LogLevel level) {
  Capture capture(false);
  set_log_level(level);
  log_all();
  return capture.text();
}

TEST_F(Log, LevelsAddUp) {
  const std::string quiet = "pellucid: error: e1\npellucid: warning: w2\n";
  EXPECT_EQ(logged(LogLevel::quiet), quiet);
  EXPECT_EQ(logged(LogLevel::normal), quiet + "pellucid: i3\n");
  EXPECT_EQ(logged(LogLevel::verbose), quiet + "pellucid: i3\npellucid: v4\n");
}

TEST_F(Log, ColoursOnTerminalsOnlyAndNotAgainstTheWish) {
  Capture coloured(true);
  log_error("x");
  EXPECT_NE(coloured.text().find("\x1b[1;31merror:\x1b[0m x"), std::string::npos);
  Capture plain(true);
  setenv("NO_COLOR", "1", 1);
  log_error("x");
  EXPECT_EQ(plain.text(), "pellucid: error: x\r\n");
}

TEST_F(Log, ProgressIsFittedAndVanishesAndMakesRoomForTheLog) {
  Capture capture(true);
  {
    Progress progress("render");
    progress.update(std::string(100, 'x'));
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
    log_info("hello");
  }
  const std::string text = capture.text();
  const std::string wipe = "\r\x1b[2K";
  EXPECT_EQ(text.rfind(wipe + "render 0.", 0), 0u) << text;
  EXPECT_NE(text.find(wipe + "pellucid: hello\r\nrender 0."), std::string::npos) << text;
  EXPECT_EQ(text.substr(text.size() - wipe.size()), wipe);
  std::size_t paints = 0;  // two by the clock, one after the log line
  for (std::size_t at = 0; (at = text.find("render", at)) != std::string::npos; ++at) {
    ++paints;
    EXPECT_LE(text.find_first_of("\r\n", at) - at, 29u) << text;
  }
  EXPECT_GE(paints, 2u);
  EXPECT_LE(paints, 3u);
}

TEST_F(Log, ProgressIsSilentInPipesForTenSecondsAndWhenQuiet) {
  Capture pipe_end(false);
  {
    Progress progress("render");
    progress.update("1 %");
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
  }
  EXPECT_EQ(pipe_end.text(), "");
  Capture terminal(true);
  set_log_level(LogLevel::quiet);
  {
    const Progress progress("render");
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
  }
  EXPECT_EQ(terminal.text(), "");
}

TEST_F(Log, SecondProgressIsSilent) {
  Capture capture(true);
  {
    Progress outer("outer"), inner("inner");
    inner.update("text");
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
  }
  EXPECT_EQ(capture.text().find("inner"), std::string::npos);
}

TEST(FitLine, CutsCharactersNotBytes) {
  EXPECT_EQ(fit_line("abcdef", 6), "abcdef");
  EXPECT_EQ(fit_line("abcdefg", 6), "abc...");
  EXPECT_EQ(fit_line("\xc3\xa4\xc3\xb6\xc3\xbc", 3), "\xc3\xa4\xc3\xb6\xc3\xbc");
  EXPECT_EQ(fit_line("\xc3\xa4\xc3\xb6\xc3\xbcxyz", 5), "\xc3\xa4\xc3\xb6...");
  EXPECT_EQ(fit_line("abc", 2), "..");
  EXPECT_EQ(fit_line("abc", -1), "");
}

}  // namespace
}  // namespace pellucid

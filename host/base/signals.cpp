// Handlers do nothing but set lock-free flags, so they are safe in any thread at any time.
#include "base/signals.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>

#include "base/error.h"

namespace pellucid {
namespace {

std::atomic<int> stop_number{0};
std::atomic<bool> write_now{false};
std::atomic<bool> installed{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free,
              "handlers may only touch lock-free atomics");

extern "C" void on_stop(int number) {
  int none = 0;
  if (!stop_number.compare_exchange_strong(none, number)) _exit(128 + number);
}

extern "C" void on_write(int) {
  write_now = true;
}

void install(int number, void (*handler)(int), struct sigaction& old) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;  // a signal must not make reads and writes of drivers fail
  sigemptyset(&action.sa_mask);
  PELLUCID_CHECK(sigaction(number, &action, &old) == 0, "signal handlers can be installed");
}

}  // namespace

void prepare_process() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; ++fd) {
    // open() takes the lowest free number, which is this one. Opened the wrong way round on
    // purpose: using it must fail as it would have without us.
    if (fcntl(fd, F_GETFD) < 0) (void)open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

StopSignal::StopSignal() {
  PELLUCID_CHECK(!installed.exchange(true), "only one StopSignal lives at a time");
  stop_number = 0;
  write_now = false;
  install(SIGINT, on_stop, old_int_);
  install(SIGTERM, on_stop, old_term_);
  install(SIGUSR1, on_write, old_usr1_);
}

void StopSignal::reinstall() {
  struct sigaction theirs;
  install(SIGINT, on_stop, theirs);
  install(SIGTERM, on_stop, theirs);
  install(SIGUSR1, on_write, theirs);
}

StopSignal::~StopSignal() {
  sigaction(SIGINT, &old_int_, nullptr);
  sigaction(SIGTERM, &old_term_, nullptr);
  sigaction(SIGUSR1, &old_usr1_, nullptr);
  installed = false;
}

bool StopSignal::stop_requested() const {
  return stop_number != 0;
}
int StopSignal::number() const {
  return stop_number;
}
bool StopSignal::take_write_request() {
  return write_now.exchange(false);
}

}  // namespace pellucid

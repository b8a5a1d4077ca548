// Signals as flags the render loop polls: stop after the pass in hand, or write the image now.
#pragma once

#include <csignal>

namespace pellucid {

/// For the first line of main(): writing to a closed pipe or beyond a size limit fails with an
/// errno instead of ending the process, and no file of ours can become standard output where that
/// was closed.
void prepare_process();

/// While one lives: the first SIGINT or SIGTERM only sets a flag, the second ends the process at
/// once with 128 + its number; SIGUSR1 asks for the image so far. One at a time.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  /// To be called when a driver is loaded and has built its kernels: the LLVM inside of it installs
  /// handlers of its own, and its one for SIGUSR1 swallows the signal.
  void reinstall();

  bool stop_requested() const;
  int number() const;         ///< the signal that asked to stop, 0 if none did
  bool take_write_request();  ///< true once per SIGUSR1 (several in between count as one)

 private:
  struct sigaction old_int_, old_term_, old_usr1_;
};

}  // namespace pellucid

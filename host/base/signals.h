// Signals as flags the render loop polls: stop after the pass in hand, or write the image now.
#pragma once

#include <csignal>

namespace pellucid {

/// While one lives: the first SIGINT or SIGTERM only sets a flag, the second ends the process at
/// once with 128 + its number; SIGUSR1 asks for the image so far. One at a time.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  bool stop_requested() const;
  int number() const;         ///< the signal that asked to stop, 0 if none did
  bool take_write_request();  ///< true once per SIGUSR1 (several in between count as one)

 private:
  struct sigaction old_int_, old_term_, old_usr1_;
};

}  // namespace pellucid

// What measurements call time.
#pragma once

#include <sys/resource.h>

namespace pellucid {

/// Of this process so far, all threads.
inline double cpu_seconds() {
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  return double(use.ru_utime.tv_sec + use.ru_stime.tv_sec) +
         1e-6 * double(use.ru_utime.tv_usec + use.ru_stime.tv_usec);
}

/// On a CPU device, CPU seconds of this process over the cores used: other processes on the machine
/// then disturb less. Elsewhere the wall seconds that a run returns.
struct Clock {
  bool cpu;
  int cores;
  template <typename F>
  double operator()(F&& run) const {
    const double before = cpu_seconds();
    const double wall = run();
    return cpu ? (cpu_seconds() - before) / cores : wall;
  }
};

}  // namespace pellucid

// The clock of phases, and when this process began.
#include "base/phase_clock.h"

#include <unistd.h>
#include <ctime>

#include <algorithm>
#include <fstream>
#include <numeric>
#include <sstream>
#include <string>

namespace pellucid {
namespace {

/// Since this process was started: Linux tells to a hundredth of a second (proc(5), stat, field
/// 22: ticks after boot). 0 where nobody tells.
double process_age() {
  constexpr int fields_after_name = 20;  // fields 3 to 22
  std::ifstream file("/proc/self/stat");
  std::string line;
  std::getline(file, line);
  std::istringstream fields(line.substr(line.rfind(')') + 1));  // the name may hold blanks
  std::string field;
  for (int i = 0; i < fields_after_name; ++i) fields >> field;
  timespec boot{};
  if (!fields || clock_gettime(CLOCK_BOOTTIME, &boot) != 0) return 0;
  const double started = std::strtod(field.c_str(), nullptr) / double(sysconf(_SC_CLK_TCK));
  return std::max(0.0, double(boot.tv_sec) + 1e-9 * double(boot.tv_nsec) - started);
}

}  // namespace

PhaseClock::PhaseClock(Phase first, double already) : now_(first) {
  seconds_[std::size_t(first)] = already;
}

void PhaseClock::enter(Phase phase) {
  if (std::this_thread::get_id() != owner_) return;
  seconds_[std::size_t(now_)] += running();
  since_ = Time::now();
  now_ = phase;
}

double PhaseClock::seconds(Phase phase) const {
  return seconds_[std::size_t(phase)] + (phase == now_ ? running() : 0.0);
}

double PhaseClock::total() const {
  return std::accumulate(seconds_.begin(), seconds_.end(), running());
}

PhaseClock& process_clock() {
  static PhaseClock clock(Phase::start, process_age());
  return clock;
}

}  // namespace pellucid

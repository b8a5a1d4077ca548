// Reads the kernel's account of processor time: the first line of /proc/stat.
#include "study/machine_load.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <string>
#include <thread>

#include "base/clock.h"

namespace pellucid {

MachineLoad::Ticks MachineLoad::now() {
  Ticks t;
  std::ifstream file("/proc/stat");
  std::string cpu;
  // user nice system idle iowait irq softirq steal; guests' time is within user's.
  double value[8] = {};
  if (!(file >> cpu) || cpu != "cpu") return t;
  for (double& v : value) file >> v;
  if (!file) return t;
  const double tick = 1.0 / double(sysconf(_SC_CLK_TCK));
  for (double v : value) t.all += v * tick;
  t.busy = t.all - (value[3] + value[4]) * tick;
  t.ours = cpu_seconds();
  return t;
}

MachineLoad::MachineLoad() : start_(now()) {}

double MachineLoad::share() const {
  const Ticks end = now();
  const double all = end.all - start_.all;
  if (!(all > 0)) return 0;
  return std::clamp(((end.busy - start_.busy) - (end.ours - start_.ours)) / all, 0.0, 1.0);
}

double foreign_load_now() {
  constexpr auto moment = std::chrono::milliseconds(500);
  const MachineLoad load;
  std::this_thread::sleep_for(moment);
  return load.share();
}

}  // namespace pellucid

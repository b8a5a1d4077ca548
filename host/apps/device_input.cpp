// Options that name and bound the device.
#include "apps/device_input.h"

#include <CLI/App.hpp>

#include "base/log.h"
#include "base/parallel.h"

namespace pellucid {

void DeviceFlags::declare(CLI::App& app) {
  app.add_option("--device", device, "OpenCL device: index as in `devices`, or part of its name")
      ->type_name("SPEC")
      ->envname("PELLUCID_DEVICE");
}

void DeviceFlags::declare_threads(CLI::App& app) {
  constexpr unsigned most = 1024;
  app.add_option("--threads", threads,
                 "threads of a CPU device and of the host, at most (default: all cores)")
      ->check(CLI::Range(1u, most))
      ->type_name("N");
}

void DeviceFlags::limit() const {
  if (threads > 0) limit_threads(threads);
}

Device DeviceFlags::open() const {
  Device target = Device::open(device);
  const DeviceInfo& info = target.info();
  if (threads > 0 && info.cpu && info.compute_units > threads)
    log_warn("--threads {}: the driver of {} uses {} nevertheless", threads, info.name,
             info.compute_units);
  return target;
}

}  // namespace pellucid

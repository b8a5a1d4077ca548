// What commands on devices share: which one, and with how many threads.
#pragma once

#include <string>

#include "cl/device.h"

namespace CLI {
class App;
}

namespace pellucid {

struct DeviceFlags {
  std::string device;
  unsigned threads = 0;  ///< 0: as the driver likes

  /// Declares --device, and --threads for commands that work rather than tell.
  void declare(CLI::App& app);
  void declare_threads(CLI::App& app);

  /// To be called before any work: drivers read their limit when they are loaded.
  void limit() const;
  /// Warns where a CPU's driver does not keep to --threads. Throws DeviceError.
  Device open() const;
};

}  // namespace pellucid

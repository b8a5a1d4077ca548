// A pass over many work-items as several launches, none of which keeps the device busy for long:
// drivers of GPUs that also draw the screen end kernels that do, and nobody else gets a turn.
#pragma once

#include <cstddef>
#include <memory>

#include "cl/device.h"
#include "shared/layout.h"

namespace pellucid {

class LaunchParts {
 public:
  /// `items`: work-items of every launch; 0: as many as launches so far show to be quick enough.
  explicit LaunchParts(std::size_t items = 0);

  /// Enqueues `kernel` over `items` work-items, in groups of `group`; parameter `launch_index` is
  /// the launch. What is computed does not depend on the parts. Waits for the first ones, to learn
  /// from them.
  void enqueue(Device& device, Kernel& kernel, unsigned launch_index, Launch launch,
               std::size_t items, std::size_t group, const std::shared_ptr<PassTime>& time);

  /// After Device::finish(): learns from the longest launch since the last call.
  void learn(PassTime& time);

 private:
  bool fixed_, settled_;
  std::size_t items_;
};

}  // namespace pellucid

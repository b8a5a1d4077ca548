// Where hard cases are measured: the device, its kernels, and how much is spent on it.
#pragma once

#include <functional>
#include <string>

#include "cl/device.h"
#include "scene/scene.h"

namespace pellucid::stability {

struct Lab {
  Device device;
  std::string kernel_dir = {};  ///< read kernels from this folder; "": the program's own
  /// Rays and samples are multiplied by it; 1 is what CI has time for.
  double effort = 1;
  /// Shipped scenes by name.
  std::function<Scene(const std::string&)> open_scene = {};
  /// Told what long cases are at.
  std::function<void(const std::string&)> progress = {};

  std::size_t count(std::size_t at_effort_1) const {
    return static_cast<std::size_t>(double(at_effort_1) * effort);
  }
};

}  // namespace pellucid::stability

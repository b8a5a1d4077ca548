// The device's arithmetic and functions against double, over a million arguments.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cl/device.h"
#include "render/float_mode.h"

namespace pellucid {

struct MathError {
  std::string function;
  double worst = 0;  ///< NaN where a result is none
  double bound = 0;  ///< what kernels count on (kernels/shared/probe.h)
  std::string unit;  ///< of both
  bool holds() const { return worst <= bound; }
};

/// One for each of MATH_PROBES, compiled as renders in this mode are. Throws DeviceError.
std::vector<MathError> probe_math(Device& device, FloatMode mode, std::size_t arguments = 1000000);

}  // namespace pellucid

// Checks that a device does what the rest of the program assumes: struct layouts and a render whose
// value is known.
#pragma once

#include <string>
#include <vector>

#include "cl/device.h"
#include "render/integrator.h"

namespace pellucid {

/// Compares sizes and offsets of all shared structs; returns the differences in words ("" each:
/// none).
std::vector<std::string> probe_layout(Device& device);

struct SelfTestRender {
  double mean = 0, expected = 0, standard_error = 0;
  bool passed = false;
};
/// Renders the inside of an emitting sphere, radiance Le / (1 - reflectance) everywhere; passes
/// within five standard errors.
SelfTestRender selftest_render(const Device& device, const Integrator& integrator);

}  // namespace pellucid

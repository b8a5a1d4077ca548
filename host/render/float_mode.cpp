// Names of the modes of arithmetic, and what they ask of the device compiler.
#include "render/float_mode.h"

#include <algorithm>

#include "base/error.h"

namespace pellucid {

std::vector<std::string> float_mode_names() {
  return {"strict", "mad", "fast"};
}

std::string float_mode_name(FloatMode mode) {
  return float_mode_names().at(static_cast<std::size_t>(mode));
}

FloatMode find_float_mode(const std::string& name) {
  const std::vector<std::string> names = float_mode_names();
  const auto found = std::find(names.begin(), names.end(), name);
  PELLUCID_CHECK(found != names.end(), "name of a float mode");
  return static_cast<FloatMode>(found - names.begin());
}

std::string float_mode_options(FloatMode mode) {
  // Not -cl-fast-relaxed-math: it lets the compiler drop the very tests that count NaN and Inf.
  return mode == FloatMode::fast ? " -cl-unsafe-math-optimizations" : "";
}

}  // namespace pellucid

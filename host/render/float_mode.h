// How exact the arithmetic of kernels is.
#pragma once

#include <string>
#include <vector>

namespace pellucid {

/// Films of different modes are different pictures: their roundings are not the same.
enum class FloatMode {
  strict,  ///< every operation rounded as written: the same bits from the same build and device
  mad,     ///< a b + c may be one rounding; not where rays meet shapes
  fast,    ///< and the compiler may reorder, and divide by multiplying; NaN and Inf still count
};

/// In the order of the enum.
std::vector<std::string> float_mode_names();
std::string float_mode_name(FloatMode mode);
/// By name; `name` must be one of float_mode_names().
FloatMode find_float_mode(const std::string& name);

/// For the device compiler.
std::string float_mode_options(FloatMode mode);

}  // namespace pellucid

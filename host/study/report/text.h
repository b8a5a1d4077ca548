// Figures as reports print them: few digits, with units, and "-" for what is no number.
#pragma once

#include <string>

namespace pellucid {

/// So many significant digits: "0.0038", "410", "3.1e-7".
std::string digits(double value, int significant = 2);

/// "0.83 %" of a share.
std::string percent(double share, int significant = 2);

/// In the unit that suits: "4.1 ms", "38 s", "34 min", "5.1 h", "3.2 d", "12 y".
std::string duration(double seconds, int significant = 2);

/// "38 s [34, 43]": the interval in the unit of the value.
std::string duration_interval(double seconds, double low, double high);

}  // namespace pellucid

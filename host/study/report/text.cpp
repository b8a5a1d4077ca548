// Figures in few digits: the same on every machine, whatever its locale.
#include "study/report/text.h"

#include <fmt/format.h>

#include <cmath>

namespace pellucid {
namespace {

struct Unit {
  double seconds;  ///< of one
  double from;     ///< seconds from which on it is used
  const char* name;
};

/// Seconds up to ten minutes, so that times to a target are compared at a glance.
const Unit& unit_of(double seconds) {
  static const Unit units[] = {{31557600, 63115200, "y"},
                               {86400, 172800, "d"},
                               {3600, 7200, "h"},
                               {60, 600, "min"},
                               {1, 0.1, "s"},
                               {1e-3, 1e-4, "ms"},
                               {1e-6, 0, "us"}};
  for (const Unit& unit : units)
    if (seconds >= unit.from) return unit;
  return units[4];
}

}  // namespace

std::string digits(double value, int significant) {
  if (!std::isfinite(value)) return "-";
  if (value == 0) return "0";
  const std::string scientific = fmt::format("{:.{}e}", value, significant - 1);
  const std::size_t at = scientific.find('e');
  const int exponent = std::stoi(scientific.substr(at + 1));
  if (exponent < -4 || exponent > 5)
    return fmt::format("{}e{}", scientific.substr(0, at), exponent);
  if (exponent < significant) return fmt::format("{:.{}f}", value, significant - 1 - exponent);
  const double place = std::pow(10.0, exponent - significant + 1);
  return fmt::format("{:.0f}", std::round(value / place) * place);
}

std::string percent(double share, int significant) {
  return std::isfinite(share) ? digits(100 * share, significant) + " %" : "-";
}

std::string duration(double seconds, int significant) {
  if (!std::isfinite(seconds)) return "-";
  if (seconds == 0) return "0 s";
  const Unit& unit = unit_of(seconds);
  return fmt::format("{} {}", digits(seconds / unit.seconds, significant), unit.name);
}

std::string duration_interval(double seconds, double low, double high) {
  if (!std::isfinite(seconds)) return "-";
  const double unit = unit_of(seconds).seconds;
  return fmt::format("{} [{}, {}]", duration(seconds), digits(low / unit), digits(high / unit));
}

}  // namespace pellucid

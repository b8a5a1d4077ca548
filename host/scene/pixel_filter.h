// Pixel filters: the one table of their names, widths and formulas.
#pragma once

#include <string>
#include <vector>

namespace pellucid {

enum class PixelFilter { box, tent, gaussian, blackman_harris };

/// All are products of the same function of x and of y, symmetric, and nowhere negative.
struct PixelFilterInfo {
  PixelFilter filter;
  const char* name;
  double radius;              ///< pixels from the centre; 0 beyond
  const char* formula;        ///< for people, x in pixels
  double (*value)(double x);  ///< for x in [0, radius], of any scale
};

/// In the order of the enum.
const std::vector<PixelFilterInfo>& pixel_filters();
const PixelFilterInfo& pixel_filter_info(PixelFilter filter);
std::vector<std::string> pixel_filter_names();

/// By name; `name` must be one of pixel_filter_names().
PixelFilter find_pixel_filter(const std::string& name);

}  // namespace pellucid

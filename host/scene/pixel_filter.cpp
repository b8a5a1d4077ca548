// Formulas of the pixel filters, at the widths that other renderers made familiar.
#include "scene/pixel_filter.h"

#include <cmath>

#include "base/error.h"

namespace pellucid {
namespace {

constexpr double two_pi = 6.28318530717958647692;
constexpr double tent_radius = 1.0;
constexpr double gaussian_radius = 1.5, gaussian_sigma = 0.5;  // pbrt's widths, and its way to end
constexpr double harris_radius = 1.5;                          // the width of Blender's Cycles

double box(double) {
  return 1.0;
}
double tent(double x) {
  return tent_radius - x;
}
double gaussian(double x) {
  const auto bell = [](double t) {
    return std::exp(-0.5 * t * t / gaussian_sigma / gaussian_sigma);
  };
  return bell(x) - bell(gaussian_radius);
}
/// The four-term window of [Harris78], ending at 6e-5 of its height.
double blackman_harris(double x) {
  const double phase = two_pi * (0.5 + 0.5 * x / harris_radius);
  return 0.35875 - 0.48829 * std::cos(phase) + 0.14128 * std::cos(2 * phase) -
         0.01168 * std::cos(3 * phase);
}

}  // namespace

const std::vector<PixelFilterInfo>& pixel_filters() {
  static const std::vector<PixelFilterInfo> table{
      {PixelFilter::box, "box", 0.5, "1", box},
      {PixelFilter::tent, "tent", tent_radius, "1 - |x|", tent},
      {PixelFilter::gaussian, "gaussian", gaussian_radius,
       "exp(-x^2 / (2 s^2)) less its value at the radius, s = 0.5", gaussian},
      {PixelFilter::blackman_harris, "blackman-harris", harris_radius,
       "the window of that name, four terms", blackman_harris},
  };
  return table;
}

const PixelFilterInfo& pixel_filter_info(PixelFilter filter) {
  return pixel_filters().at(static_cast<std::size_t>(filter));
}

std::vector<std::string> pixel_filter_names() {
  std::vector<std::string> names;
  for (const PixelFilterInfo& f : pixel_filters()) names.emplace_back(f.name);
  return names;
}

PixelFilter find_pixel_filter(const std::string& name) {
  for (const PixelFilterInfo& f : pixel_filters())
    if (name == f.name) return f.filter;
  throw InternalError("no pixel filter is called " + name);
}

}  // namespace pellucid

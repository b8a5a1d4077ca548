// The pixel filter as the table that kernels draw offsets from (kernels/camera/filter.h).
#include "pack/packer.h"

namespace pellucid {
namespace {

/// Integral of a filter over [a, b] by Gauss-Legendre, exact to rounding over a piece this short.
double integral(const PixelFilterInfo& f, double a, double b) {
  constexpr double node[] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                             0.9602898564975363};
  constexpr double weight[] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                               0.1012285362903763};
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  double sum = 0;
  for (int i = 0; i < 4; ++i)
    sum += weight[i] * (f.value(middle - half * node[i]) + f.value(middle + half * node[i]));
  return sum * half;
}

/// The half of a filter at x >= 0, cut into pieces; sums start at the edge, where differences of
/// integrals from 0 would lose all digits.
class HalfFilter {
 public:
  explicit HalfFilter(const PixelFilterInfo& f) : f_(f) {
    for (int p = pieces; p-- > 0;) beyond_[p] = beyond_[p + 1] + integral(f, at(p), at(p + 1));
  }
  /// The integral of the filter on both sides.
  double whole() const { return 2 * beyond_[0]; }
  /// x with `share` of the whole beyond it.
  double offset(double share) const {
    const double goal = share * beyond_[0];
    int p = 0;
    while (p < pieces - 1 && beyond_[p + 1] > goal) ++p;
    double low = at(p), high = at(p + 1);
    for (int i = 0; i < 50; ++i) {
      const double x = 0.5 * (low + high);
      (beyond_[p + 1] + integral(f_, x, at(p + 1)) > goal ? low : high) = x;
    }
    return 0.5 * (low + high);
  }

 private:
  static constexpr int pieces = 32;
  double at(int p) const { return f_.radius * p / pieces; }

  const PixelFilterInfo& f_;
  double beyond_[pieces + 1] = {};
};

}  // namespace

void pack_filter(const Scene& scene, PackedScene& out) {
  if (scene.settings.filter == PixelFilter::box) return;
  out.features.set(INTG_FILTER);
  const PixelFilterInfo& f = pixel_filter_info(scene.settings.filter);
  const HalfFilter half(f);
  out.filter_table.resize(FILTER_STEPS + 1);
  for (uint i = 0; i <= FILTER_STEPS; ++i) {
    const double r = double(i) / FILTER_STEPS;
    out.filter_table[i] = float(half.offset(r * r));
  }
  out.filter_table.front() = float(f.radius);
  out.filter_table.back() = 0.0f;
  out.filter_values.resize(FILTER_STEPS + 1);
  for (uint i = 0; i <= FILTER_STEPS; ++i)
    out.filter_values[i] = float(f.value(f.radius * i / FILTER_STEPS) / half.whole());
}

}  // namespace pellucid

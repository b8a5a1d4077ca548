// The radius of merging (numerics 17): it shrinks by its law, scales exactly, and renders with
// different ones converge to the same.
//
// The radius of a pass is a function of its number alone [Knaus11], so that passes can be cut and
// resumed; where it would fall below what positions are known to, it stops (MERGE_RADIUS_ULPS).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/launch.h"
#include "stability/estimates.h"
#include "stability/measurements.h"

namespace pellucid::stability {
namespace {

double radius_of(std::uint64_t pass, double first, double alpha) {
  Launch launch{};
  launch.iteration = uint(pass);
  launch.light_paths = 1000;
  set_merging(launch, {first, alpha, 0, false});
  return launch.radius;
}

}  // namespace

void radius_shrinks_by_its_law(const Lab& lab, Findings& findings) {
  double slope_error = 0;
  std::uint64_t unscaled = 0;
  for (double alpha : {0.5, 2.0 / 3, 0.75, 1.0})
    for (double first : {1e-6, 0.03, 1e3})
      for (std::uint64_t pass : {9u, 9999u, 4294967294u}) {
        const double r = radius_of(pass, first, alpha);
        const double slope = std::log(r / first) / std::log(double(pass) + 1);
        slope_error = std::max(slope_error, std::abs(slope - 0.5 * (alpha - 1)));
        for (int k : {-30, 30})
          unscaled += radius_of(pass, std::ldexp(first, k), alpha) != std::ldexp(r, k);
      }
  findings.at_most("error of the slope of log r", slope_error, 1e-6);
  findings.none("radii that do not scale by 2^k", unscaled);

  // Its bias goes with r^2: of L(r) and L(r / 4), L = (16 L(r / 4) - L(r)) / 15.
  const Scene scene = lab.open_scene("equal-lights");
  const auto means = [&](const std::string& method, double radius) {
    Build build{method, 16, 16};
    build.radius = radius, build.radius_alpha = 1;
    if (method == "sppm") build.light_paths = 1 << 10;  // all its light but the direct
    return measured_means(lab, scene, build, {64, 1, 4, MIS_BALANCE}, 0.5 * usual_resolution);
  };
  const std::array<Estimate, 3> expected = means("path", 0);
  for (const char* method : {"sppm", "bpm", "vcm"})
    for (double r : {0.02, 0.08}) {
      const std::array<Estimate, 3> wide = means(method, r), narrow = means(method, r / 4);
      std::array<Estimate, 3> limit{};
      for (std::size_t c = 0; c < 3; ++c) {
        limit[c].mean = (16 * narrow[c].mean - wide[c].mean) / 15;
        limit[c].variance = (256 * narrow[c].variance + wide[c].variance) / 225;
      }
      compare_means(lab, findings,
                    fmt::format("limit of radii {} and {}, {} beside path", r, r / 4, method),
                    limit, expected);
    }
}

}  // namespace pellucid::stability

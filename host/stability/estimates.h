// Estimates beside what is known, and beside each other.
#pragma once

#include <array>
#include <string>

#include "stability/renderer.h"
#include "stability/suite.h"

namespace pellucid::stability {

/// How well a value is known at least, from the noise of 4.5 standard errors (7e-6, two-sided).
constexpr double usual_resolution = 0.015;

/// Relative error within noise and `slack`, which is for what is not noise: rounding, footprints.
/// Fails, too, where noise exceeds `resolution` (over the root of the effort).
void compare(const Lab& lab, Findings& findings, const std::string& what, const Estimate& e,
             double expected, double slack, double resolution = usual_resolution);

/// Whether two pictures are means of the same: all channels, within their noise.
void compare_means(const Lab& lab, Findings& findings, const std::string& what,
                   const std::array<Estimate, 3>& a, const std::array<Estimate, 3>& b,
                   double resolution = usual_resolution);

/// Whether two pictures are means of the same, and their tiles, too (numerics A4): a tile's noise
/// is four times the picture's, so this sees what is wrong in one place and little in all.
void compare_pictures(const Lab& lab, Findings& findings, const std::string& what,
                      const Measured& a, const Measured& b, double resolution = usual_resolution);

/// Shares of throughput that run.max_depth cuts off, by CUT_*: their noise is the spread of runs.
std::array<Estimate, CUT_COUNT> measured_cuts(Renderer& renderer, Sampling run);

/// A picture whose means are known so well.
Measured measured(const Lab& lab, const Scene& scene, const Build& build, Sampling run,
                  double resolution = usual_resolution);
/// Its means.
std::array<Estimate, 3> measured_means(const Lab& lab, const Scene& scene, const Build& build,
                                       Sampling run, double resolution = usual_resolution);
/// Of its first channel.
Estimate measured_mean(const Lab& lab, const Scene& scene, const Build& build, const Sampling& run);

}  // namespace pellucid::stability

// Estimates within their noise.
#include "stability/estimates.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pellucid::stability {
namespace {

constexpr double sigmas = 4.5;
/// Of tiles, of which there are many: beyond it by chance are 1 in 1e6 where 32 runs tell the
/// spread (Student's t).
constexpr double tile_sigmas = 6;

/// What is too noisy to judge has not shown anything.
void require_resolution(const Lab& lab, Findings& findings, const std::string& what, double noise,
                        double resolution) {
  const double bound = resolution / std::sqrt(lab.effort);
  if (!(noise <= bound)) findings.at_most(what + ": too noisy to judge", noise, bound);
}

}  // namespace

void compare(const Lab& lab, Findings& findings, const std::string& what, const Estimate& e,
             double expected, double slack, double resolution) {
  const double noise = sigmas * e.error() / expected;
  findings.at_most(what + ": relative error", std::abs(e.mean - expected) / expected,
                   slack + noise);
  require_resolution(lab, findings, what, noise, resolution);
}

void compare_means(const Lab& lab, Findings& findings, const std::string& what,
                   const std::array<Estimate, 3>& a, const std::array<Estimate, 3>& b,
                   double resolution) {
  double off = 0, at = std::numeric_limits<double>::infinity(), widest = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double noise = sigmas * std::sqrt(a[c].variance + b[c].variance) / b[c].mean;
    const double error = std::abs(a[c].mean / b[c].mean - 1);
    widest = std::max(widest, noise);
    if (error - noise >= off - at) off = error, at = noise;
  }
  findings.at_most(what + ": relative difference", off, at + 1e-6);
  require_resolution(lab, findings, what, widest, resolution);
}

void compare_pictures(const Lab& lab, Findings& findings, const std::string& what,
                      const Measured& a, const Measured& b, double resolution) {
  compare_means(lab, findings, what, a.image, b.image, resolution);
  double worst = 0;
  for (std::size_t t = 0; t < a.tiles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const Estimate &x = a.tiles[t][c], &y = b.tiles[t][c];
      const double off = std::abs(x.mean - y.mean), noise = std::sqrt(x.variance + y.variance);
      if (off > 0) worst = std::max(worst, off / noise);
    }
  findings.at_most(what + ": tiles apart, in standard errors", worst, tile_sigmas);
}

std::array<Estimate, CUT_COUNT> measured_cuts(Renderer& renderer, Sampling run) {
  constexpr std::size_t parts = 32;
  std::array<std::vector<double>, CUT_COUNT> shares;
  run.spp = (run.spp + parts - 1) / parts;
  renderer.take_cuts();
  for (std::size_t k = 0; k < parts; ++k, ++run.seed) {
    renderer.render(run);
    const DepthCuts cuts = renderer.take_cuts();
    for (std::size_t i = 0; i < cuts.size(); ++i) shares[i].push_back(cuts[i].share());
  }
  std::array<Estimate, CUT_COUNT> found{};
  for (std::size_t i = 0; i < CUT_COUNT; ++i) {
    for (double share : shares[i]) found[i].mean += share / double(parts);
    for (double share : shares[i])
      found[i].variance += std::pow(share - found[i].mean, 2) / double(parts * (parts - 1));
  }
  return found;
}

Measured measured(const Lab& lab, const Scene& scene, const Build& build, Sampling run,
                  double resolution) {
  Renderer renderer(lab, scene, build);
  const double error = resolution / std::sqrt(lab.effort) / 6;
  run.spp =
      std::max<std::uint64_t>(64, renderer.spp_for(run, error, std::uint64_t(65536 * lab.effort)));
  return renderer.measure(run);
}

std::array<Estimate, 3> measured_means(const Lab& lab, const Scene& scene, const Build& build,
                                       Sampling run, double resolution) {
  return measured(lab, scene, build, run, resolution).image;
}

Estimate measured_mean(const Lab& lab, const Scene& scene, const Build& build,
                       const Sampling& run) {
  return measured_means(lab, scene, build, run)[0];
}

}  // namespace pellucid::stability

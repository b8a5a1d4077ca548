// How often the error estimate keeps its word: renders of many seeds, each ended by it, against the
// mean of many others with just as many passes (of the same radii where there is merging: noise is
// what is claimed). PELLUCID_TIER=full: 200 renders by each of five methods; else a sample.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/relmse.h"
#include "integrators/reach.h"
#include "integrators/registry.h"
#include "render_harness.h"

namespace pellucid::test {
namespace {

using Means = std::vector<std::array<double, 3>>;

bool full_tier() {
  return tier_tolerance() < 0.01;
}

/// Few pixels: the fewer, the more one render's error strays from what is expected.
Build build_for(const std::string& method) {
  Build build;
  build.method = method;
  build.width = build.height = 16;
  build.sampler = Sampler::sobol;  // what users have
  return build;
}

double relmse(const Picture& picture, const Means& reference) {
  double mean = 0, sum = 0;
  const double n = 3.0 * double(reference.size());
  for (const auto& pixel : reference)
    for (double m : pixel) mean += m / n;
  const double e = RELMSE_EPSILON * mean;
  for (std::size_t i = 0; i < reference.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double m = reference[i][c], d = picture.pixels[i][c].mean - m;
      sum += d * d / (m * m + e * e) / n;
    }
  return sum;
}

/// Renders of one method in one scene, and what they should be.
class Trials {
 public:
  Trials(const std::string& scene, const std::string& method)
      : renderer_(scene_named(scene), build_for(method)) {}

  /// relMSE of one pass, from so many that the estimate's own weights do no harm.
  double of_pass() {
    return most_passes *
           summarise(renderer_.render({most_passes, 999983, long_enough}).film).relmse;
  }
  const PackedScene& packed() const { return renderer_.packed(); }
  std::pair<Picture, ErrorEstimate> render_to(double target, std::uint64_t seed) {
    return renderer_.render_to(target, {most_passes, seed, long_enough});
  }
  /// Mean of renders of so many passes; its noise makes relMSE look larger by 1/64, or 1/16.
  const Means& reference(std::uint64_t spp) {
    Means& sum = references_[spp];
    if (!sum.empty()) return sum;
    const std::uint64_t renders = full_tier() ? 64 : 16;
    for (std::uint64_t k = 0; k < renders; ++k) {
      const Picture picture = renderer_.render({spp, 1000003 + k, long_enough});
      sum.resize(picture.pixels.size());
      for (std::size_t i = 0; i < sum.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
          sum[i][c] += picture.pixels[i][c].mean / double(renders);
    }
    return sum;
  }

 private:
  const std::uint64_t most_passes = full_tier() ? 4096 : 1024;
  Renderer renderer_;
  std::map<std::uint64_t, Means> references_;
};

struct Coverage {
  int renders = 0, stopped = 0, kept = 0;
  std::vector<double> slack;              ///< bound over true relMSE
  std::map<std::uint64_t, int> passes{};  ///< how often stopped at

  std::string text() const {
    std::string at;
    for (const auto& [spp, n] : passes) at += fmt::format(" {}x{}", n, spp);
    return fmt::format("kept {}/{} ({:.1f} %), median bound {:.2f} of the true error, passes{}",
                       kept, stopped, 100.0 * kept / std::max(1, stopped),
                       slack.empty() ? 0.0 : std::sqrt(slack[slack.size() / 2]), at);
  }
};

/// Targets lie anywhere within an octave of passes, so that looks come at any distance from them.
Coverage measure(const std::string& scene, const std::string& method, int renders) {
  Trials trials(scene, method);
  const double least_passes = full_tier() ? 128 : 32;
  const double expected = trials.of_pass() / least_passes;
  Coverage coverage;
  coverage.renders = renders;
  for (int i = 0; i < renders; ++i) {
    const double target = std::sqrt(expected / std::exp2((i + 0.5) / renders));
    const auto [picture, error] = trials.render_to(target, std::uint64_t(i));
    if (!error.reached()) continue;
    const std::uint64_t spp = picture.film.passes.count();
    const double realised = relmse(picture, trials.reference(spp));
    ++coverage.stopped;
    ++coverage.passes[spp];
    coverage.kept += realised <= target * target;
    coverage.slack.push_back(error.looks().back().upper / realised);
  }
  std::sort(coverage.slack.begin(), coverage.slack.end());
  return coverage;
}

void check(const std::string& scene, const std::string& method) {
  const int renders = full_tier() ? 200 : 24;
  const Coverage coverage = measure(scene, method, renders);
  const std::string what = fmt::format("{} {}: {}", scene, method, coverage.text());
  fmt::print("{}\n", what);
  // Where a few splats carry the error (`light`), some renders may take more than most_passes.
  EXPECT_GE(coverage.stopped, 0.95 * renders) << what;
  // 95 %, less two standard deviations of a count of so many.
  const double n = coverage.stopped;
  EXPECT_GE(coverage.kept, 0.95 * n - 2 * std::sqrt(n * 0.95 * 0.05)) << what;
  // Not at the price of stopping late: within a factor of two of the error. (Groups of heavy tails
  // spread by 0.45 of their mean, which a bound for one look in many has to multiply by 3.5.)
  EXPECT_LT(coverage.slack.at(coverage.slack.size() / 2), 4.0) << what;
}

std::vector<std::string> methods() {
  if (full_tier()) return {"path", "light", "bdpt", "sppm", "vcm"};
  return {"path", "bdpt"};
}

TEST(ErrorCoverage, room_under_a_wide_panel) {
  for (const std::string& method : methods()) check("error-room", method);
}

TEST(ErrorCoverage, glass_under_a_wide_panel) {
  if (!full_tier()) GTEST_SKIP() << "with PELLUCID_TIER=full";
  for (const std::string& method : methods()) check("error-glass", method);
}

/// `path` meets the caustic's light by chance alone. What it has not met it cannot know; but what
/// the few hits tell must keep it from stopping, and the report must say what may be missing.
TEST(ErrorCoverage, fireflies_go_on_and_are_reported) {
  constexpr double target = 0.3;
  Trials trials("glass-caustic", "path"), truth("glass-caustic", "bdpt");
  const int renders = full_tier() ? 100 : 4;
  int early = 0, fooled = 0;
  for (int i = 0; i < renders; ++i) {
    const auto [picture, error] = trials.render_to(target, std::uint64_t(i));
    early += error.reached() && relmse(picture, truth.reference(256)) > target * target;
    const auto& looks = error.looks();
    fooled += std::any_of(looks.begin(), looks.end(),
                          [&](const ErrorLook& look) { return look.relmse <= target * target; });
  }
  fmt::print("glass-caustic path: {} of {} stopped early; by the film's own variances {}\n", early,
             renders, fooled);
  EXPECT_LE(early, renders / 20);
  EXPECT_FALSE(
      chance_paths(find_integrator("path"), optics_of(trials.packed(), long_enough)).empty());
}

}  // namespace
}  // namespace pellucid::test

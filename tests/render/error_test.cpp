// How often the error estimate keeps its word: renders of many seeds, each ended by it, against the
// mean of many others with just as many passes (of the same radii where there is merging: noise is
// what is claimed). PELLUCID_TIER=full: 200 renders by each of five methods; else a sample.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

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
  const double e = relmse_epsilon * mean;
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

  /// Expected relMSE after so many passes.
  double pilot(std::uint64_t spp) {
    return summarise(renderer_.render({spp, 999983, long_enough}).film).relmse;
  }
  std::pair<Picture, ErrorEstimate> render_to(double target, std::uint64_t seed) {
    return renderer_.render_to(target, {most_passes, seed, long_enough});
  }
  /// Mean of renders of so many passes; its noise makes errors look larger by 1/64 of theirs.
  const Means& reference(std::uint64_t spp) {
    Means& sum = references_[spp];
    if (!sum.empty()) return sum;
    constexpr std::uint64_t renders = 64;
    for (std::uint64_t k = 0; k < renders; ++k) {
      const Picture picture = renderer_.render({spp, 1000003 + k, long_enough});
      sum.resize(picture.pixels.size());
      for (std::size_t i = 0; i < sum.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) sum[i][c] += picture.pixels[i][c].mean / renders;
    }
    return sum;
  }

 private:
  static constexpr std::uint64_t most_passes = 8192;
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
  constexpr std::uint64_t pilot_spp = 128;
  const double expected = trials.pilot(pilot_spp);
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
  EXPECT_EQ(coverage.stopped, renders) << what;
  // 95 %, less two standard deviations of a count of so many.
  EXPECT_GE(coverage.kept, 0.95 * renders - 2 * std::sqrt(renders * 0.95 * 0.05)) << what;
  // Not at the price of stopping late: one look more would double the passes.
  EXPECT_LT(coverage.slack.at(coverage.slack.size() / 2), 3.0) << what;
}

std::vector<std::string> methods() {
  if (full_tier()) return {"path", "light", "bdpt", "sppm", "vcm"};
  return {"path", "bdpt"};
}

TEST(ErrorCoverage, room_under_a_wide_panel) {
  for (const std::string& method : methods()) check("equal-room", method);
}

TEST(ErrorCoverage, glass_under_a_wide_panel) {
  if (!full_tier()) GTEST_SKIP() << "with PELLUCID_TIER=full";
  for (const std::string& method : methods()) check("equal-caustic", method);
}

/// `path` meets the caustic's light by chance alone. What it has not met it cannot know; but what
/// the few hits tell must keep it from stopping, and the report must say what may be missing.
TEST(ErrorCoverage, fireflies_go_on_and_are_reported) {
  Trials trials("glass-caustic", "path");
  const int renders = full_tier() ? 50 : 8;
  int early = 0, by_film = 0;
  for (int i = 0; i < renders; ++i) {
    const auto [picture, error] = trials.render_to(0.1, std::uint64_t(i));
    early += error.reached();
    for (const ErrorLook& look : error.looks()) by_film += look.relmse <= 0.01;
  }
  fmt::print("fireflies: {} of {} stopped\n", early, renders);
}

}  // namespace
}  // namespace pellucid::test

// The made-up study. Its figures follow laws of accuracy.md 3, with a little noise of a fixed seed.
#include "support/sample_study.h"

#include <cmath>

namespace pellucid::test {
namespace {

// PNG of 12 x 8 pixels: a gradient, and a pattern.
const char* picture =
    "iVBORw0KGgoAAAANSUhEUgAAAAwAAAAICAIAAABChommAAAArklEQVR42g3KIQEAIQxA0UVALABykgAIIiwCYgGQXxJggg"
    "h"
    "EIOLd009EKEIVmjAEF6awhC0c4QpPEFGKUpWmDMWVqSxlK0e5ytM/"
    "GcWoRjOG4cY0lrGNY1zj2Z86pVM7rTM63pmd1dmd07"
    "md1//kFKc6zRmOO9NZznaOc53nfwpKUIMWjMCDGaxgBye4wYs/"
    "QYEKDQY4TFiw4cCFx5+SktSkJSPxZCYr2clJbvKSD7Xja"
    "EF5cKZdAAAAAElFTkSuQmCC";
const char* error_map =
    "iVBORw0KGgoAAAANSUhEUgAAAAwAAAAICAIAAABChommAAAAWklEQVR42o2QsQ0AIQzEbogMkSFuiAzBEBn/"
    "FYvioUKiANu"
    "RIiT54cghp2y55CU34g8nSm6NMN0FJzKPRMcePeBEhVugRl9wooUIitr0gBM1qKC5lzigXr7gAyoWJumh1FegAAAAAElFT"
    "kSu"
    "QmCC";

/// Uniform in [-1, 1], by a linear congruential generator [Knuth's MMIX].
double noise(std::uint64_t& state) {
  state = state * 6364136223846793005u + 1442695040888963407u;
  return double(state >> 11) / double(1ull << 52) - 1;
}

struct Law {
  const char *integrator, *precision;
  double noise, exponent, bias;  ///< relMSE = noise t^-exponent + bias
  double first_seconds, setup;
  int rungs, runs;
};

StudyOption option_of(const Law& law) {
  StudyOption o;
  o.integrator = law.integrator, o.precision = law.precision;
  o.setup_seconds = law.setup;
  o.memory_bytes = 190u << 20;
  o.pilot_efficiency = 1 / law.noise;
  std::uint64_t state = 12345;
  for (int k = 0; k < law.runs; ++k) {
    StudyRun run{std::uint64_t(100 + k), {}};
    double seconds = law.first_seconds;
    for (int r = 0; r < law.rungs; ++r, seconds *= 2)
      run.rungs.push_back(
          {std::uint64_t(16) << r, seconds * (1 + 0.01 * noise(state)),
           (law.noise * std::pow(seconds, -law.exponent) + law.bias) * (1 + 0.15 * noise(state)),
           1 + 0.004 * noise(state)});
    o.runs.push_back(run);
  }
  double seconds = law.first_seconds;
  for (int r = 0; r < law.rungs; ++r, seconds *= 2) {
    const double variance = law.noise * std::pow(seconds, -law.exponent);
    o.splits.push_back(
        {std::uint64_t(16) << r, variance, law.bias - 0.01 * variance, law.bias + 0.04 * variance});
  }
  if (law.runs > 0) o.picture = picture, o.error_map = error_map;
  constexpr int tiles = 80 * 60;  // of 640 x 480 pixels
  for (int t = 0; t < tiles && law.runs > 1; ++t)
    o.tiles.push_back(law.noise * (1 + 0.8 * noise(state)) / seconds);
  o.tiles_within = law.runs > 1 ? 0.7 : 0;
  return o;
}

Verdict verdict_by(const Law& law, TargetKind kind, double seconds, double beyond) {
  Verdict v;
  v.kind = kind;
  v.seconds = seconds, v.low = 0.9 * seconds, v.high = 1.13 * seconds, v.beyond_factor = beyond;
  v.slope = -law.exponent, v.slope_low = v.slope - 0.05, v.slope_high = v.slope + 0.06;
  v.slope_from = -1.1, v.slope_to = -0.9;
  v.noise = law.noise, v.bias = law.bias, v.exponent = law.exponent, v.fit_residual = 0.04;
  v.energy = 0.9996, v.energy_low = 0.998, v.energy_high = 1.0012;
  return v;
}

void add(Study& study, const Law& law, TargetKind kind, double seconds, double beyond = 1) {
  study.options.push_back(option_of(law));
  study.verdicts.push_back(verdict_by(law, kind, seconds, beyond));
}

void add_options(Study& s) {
  add(s, {"vcm", "strict", 0.004, 1, 0, 1.2, 1.9, 6, 10}, TargetKind::interpolated, 38);
  s.options.back().passes = {{"light walk", 0.011}, {"sort photons", 0.004}, {"eye walk", 0.019},
                             {"connect", 0.023},    {"merge", 0.012},        {"film", 0.0006}};
  // Relaxed arithmetic is measured in pairs alone.
  add(s, {"vcm", "fast", 0.0037, 1, 0, 0, 2.2, 0, 0}, TargetKind::interpolated, 36);
  add(s, {"bdpt", "strict", 0.002, 1, 0, 1, 1.4, 6, 10}, TargetKind::measured, 21);
  s.options.back().passes = {{"eye walk", 0.018}, {"connect", 0.022}, {"light walk", 0.01}};
  s.verdicts.back().flags = {"its pictures have 0.9950 of the reference's light"};
  add(s, {"bdpt", "compact", 0.0018, 1, 0, 0, 1.4, 0, 0}, TargetKind::never, 0);
  s.verdicts.back().flags = {"a floor of 1.6 %"};
  add(s, {"path", "strict", 0.041, 1, 0, 0.6, 0.6, 7, 3}, TargetKind::extrapolated, 410, 6.8);
  s.options.back().passes = {{"eye walk", 0.0094}, {"film", 0.0002}};
  add(s, {"light", "strict", 0.9, 0.97, 0, 0.5, 0.7, 5, 4}, TargetKind::beyond, 280, 32);
  add(s, {"sppm", "strict", 0.011, 0.75, 0, 1.5, 1.6, 5, 2}, TargetKind::extrapolated, 525, 22);
  s.options.back().merges = true, s.options.back().radius_alpha = 0.75;
  s.options.back().chance = {"light straight from a small source, seen in a mirror"};
  for (Split& split : s.options.back().splits) {
    split.bias2 = 0.1 * split.variance * std::pow(double(split.spp) / 16, 0.25);
    split.bias2_upper90 = 1.3 * split.bias2;
  }
  add(s, {"nee", "strict", 0.05, 1, 1.1e-2, 0.6, 0.6, 5, 4}, TargetKind::never, 0);
  s.options.back().state = OptionState::blind;
  s.options.back().unreachable = {"caustics: light | focused by <glass> & mirrors"};
  s.verdicts.back().flags = {"cannot see caustics: light | focused by <glass> & mirrors"};
  add(s, {"naive", "strict", 40, 1, 0, 0.6, 0.6, 1, 4}, TargetKind::unknown, 0);
  s.options.back().state = OptionState::pilot;
  s.options.back().reason = "about 140 times dearer than bdpt";
  add(s, {"reference", "strict", 9, 1, 0, 11, 0.6, 2, 1}, TargetKind::unknown, 0);
  s.options.back().state = OptionState::too_slow;
  s.options.back().reason = "2 of 5 rungs fit the budget";
  add(s, {"bpm", "strict", 1, 1, 0, 1, 0, 0, 0}, TargetKind::unknown, 0);
  s.options.back().state = OptionState::refused;
  s.options.back().reason = "its pictures hold pixels that are no numbers";
  s.options.back().wrong = 3;
  for (std::size_t i : {8u, 9u, 10u}) s.verdicts[i] = Verdict{};
}

}  // namespace

Study sample_study() {
  Study s;
  s.scene = "glass caustic <of a ring> & \"more\"", s.scene_hash = "9f3a77c21be04d11";
  s.settings = "640x480 max-depth unlimited mis balance filter box sampler sobol", s.width = 640,
  s.height = 480;
  s.seconds = 583.2, s.seed = 1, s.complete = false;
  s.warnings = {"repeats differ by 14 %: the machine was disturbed"};
  s.machine = {"pthread-skylake-avx512", "PoCL 3.1", "OpenCL 1.2", "cpu", 2, 0.023};
  s.reference = {"bdpt and vcm, 16 runs each", 3e-6, 4e-4, 0.7, true, "", picture};
  add_options(s);
  s.pairs = {{"vcm", "fast", 64, 4e-6, 4.5e-6, 0.95, 0.93, 0.97, 310.5, 0, 5},
             {"bdpt", "compact", 64, 2.5e-4, 2.7e-4, 0.9, 0.88, 0.93, 5200, 0, 5},
             {"path", "mad", 64, -1e-9, 3e-9, 0.99, 0.97, 1.02, 0.25, 0, 5},
             {"sppm", "fast", 64, 1e-8, 2e-8, 0.9, 0.88, 0.93, 12, 0, 5}};
  s.recommended = 0, s.equals = {1};
  s.recommendation =
      "For this scene vcm reaches 1 % in 38 s; path needs about 410 s (extrapolated x6.8). Relaxed "
      "maths saves 5 % and floors at 0.2 %.";
  s.would_change = {"a target above 3 %: then path is as quick, set-up included",
                    "if caustics were left out (max depth 2), nee would do"};
  return s;
}

}  // namespace pellucid::test

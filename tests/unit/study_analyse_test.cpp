// Studies of methods that never were, whose truth is known: intervals cover it, and what must not
// be recommended is not (accuracy.md 9).
#include "study/analyse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "base/error.h"
#include "study/fit.h"

namespace pellucid {
namespace {

/// A method with independent pixels: relMSE sigma2 / spp + bias2(spp), and a constant time per
/// sample.
struct Truth {
  std::string name = "path";
  double sigma2 = 1, seconds_per_spp = 0.01, bias2 = 0;
  bool merges = false;
  double alpha = 1;
};

class World {
 public:
  explicit World(unsigned seed) : random_(seed) {
    study_.target = 0.02;
    study_.reference.relmse = 1e-6;
    study_.reference.energy_error = 1e-4;
    study_.budget_seconds = 600;
    study_.width = study_.height = 16;
    for (double& r : reference_) r = std::sqrt(study_.reference.relmse) * normal_(random_);
  }

  /// Nested runs, as a renderer has them: each rung holds all samples of those before.
  StudyOption& add(const Truth& truth, int runs = 10, int rungs = 6) {
    StudyOption option;
    option.integrator = truth.name;
    option.merges = truth.merges, option.radius_alpha = truth.alpha;
    for (int k = 0; k < runs; ++k) option.runs.push_back(run(truth, k, rungs));
    study_.options.push_back(option);
    return study_.options.back();
  }

  /// The same, and its relaxed precisions without runs of their own.
  void add_relaxed(const Truth& truth) {
    add(truth);
    for (const char* mode : {"mad", "fast"}) {
      StudyOption relaxed;
      relaxed.integrator = truth.name, relaxed.precision = mode;
      study_.options.push_back(relaxed);
    }
  }

  Study& study() { return study_; }
  /// Every reference value is off by so much.
  double shift = 0;
  /// Of the clock, by run.
  std::function<double(int)> drift = [](int) { return 1.0; };

 private:
  static constexpr std::size_t pixels = 256;

  StudyRun run(const Truth& truth, int k, int rungs) {
    StudyRun out;
    out.seed = std::uint64_t(k);
    std::array<double, pixels> sum{};
    double spp = 0;
    for (int r = 0; r < rungs; ++r) {
      const double next = 16 * std::pow(2, r);
      double relmse = 0, energy = 0;
      // Merging: bias of one sign that falls as spp^-(2 - 2 alpha) in its square.
      const double bias =
          std::sqrt(truth.bias2 * (truth.merges ? std::pow(next, 2 * truth.alpha - 2) : 1));
      for (std::size_t p = 0; p < pixels; ++p) {
        sum[p] += std::sqrt(truth.sigma2 * (next - spp)) * normal_(random_);
        const double value = 1 + sum[p] / next + bias, reference = 1 + reference_[p] + shift;
        relmse += std::pow(value - reference, 2) / pixels;
        energy += value / reference / pixels;
      }
      spp = next;
      const double seconds = spp * truth.seconds_per_spp * drift(k) * (1 + 0.01 * normal_(random_));
      out.rungs.push_back({std::uint64_t(spp), seconds, relmse - study_.reference.relmse, energy});
    }
    return out;
  }

  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  std::array<double, pixels> reference_{};
  Study study_;
};

// 500 studies: 90 % intervals of the time to the target hold the truth in 86 to 94 % of them, and
// in at least 85 % where it is extrapolated.
TEST(StudyAnalysis, intervals_cover_the_truth) {
  int inside[2] = {}, count[2] = {}, flagged = 0;  // interpolated, extrapolated
  for (unsigned i = 0; i < 500; ++i) {
    World world(i);
    const bool beyond = i % 2 == 1;
    const double spp = beyond ? 512.0 * (1.5 + (i % 9)) : 20.0 + (i % 23) * 20;
    Truth truth;
    truth.sigma2 = spp * std::pow(world.study().target, 2);  // reaches it at so many samples
    world.add(truth);
    analyse(world.study());
    const Verdict& v = world.study().verdicts.front();
    ASSERT_EQ(v.kind == TargetKind::extrapolated, beyond) << i << ' ' << v.seconds;
    const double truly = spp * truth.seconds_per_spp;
    ++count[beyond], inside[beyond] += v.low <= truly && truly <= v.high;
    flagged += !v.flags.empty();
  }
  std::printf("inside: %d of %d interpolated, %d of %d extrapolated\n", inside[0], count[0],
              inside[1], count[1]);
  EXPECT_LE(flagged, 25) << "of 500 without a fault";
  for (int k : {0, 1}) {
    EXPECT_GE(inside[k], 0.86 * count[k]);
    EXPECT_LE(inside[k], 0.94 * count[k]);
  }
}

// The same for a method that merges, whose noise and bias have laws of their own.
TEST(StudyAnalysis, intervals_cover_merging) {
  int inside = 0, count = 0;
  for (unsigned i = 0; i < 300; ++i) {
    World world(1000 + i);
    Truth truth{"sppm", 0, 0.01, 0, true, 0.75};
    const double spp = 512 * (1 + 0.2 * (i % 10)), relmse = std::pow(world.study().target, 2);
    truth.sigma2 = 0.7 * spp * relmse, truth.bias2 = 0.3 * std::sqrt(spp) * relmse;
    world.add(truth);
    analyse(world.study());
    const Verdict& v = world.study().verdicts.front();
    const double truly = spp * truth.seconds_per_spp;
    ++count, inside += v.low <= truly && truly <= v.high;
  }
  std::printf("inside: %d of %d merging\n", inside, count);
  EXPECT_GE(inside, 0.85 * count);
}

TEST(StudyAnalysis, a_shifted_reference_is_flagged) {
  int flagged = 0;
  constexpr int studies = 100;
  for (unsigned i = 0; i < studies; ++i) {
    World world(2000 + i);
    world.shift = i % 2 ? 0.01 : -0.01;
    world.add({"path", 0.04, 0.01});
    world.add({"bdpt", 0.02, 0.03});
    analyse(world.study());
    flagged += !world.study().reference.trusted && !conclusive(world.study());
  }
  EXPECT_GE(flagged, 95);
}

TEST(StudyAnalysis, a_right_reference_is_believed) {
  int doubted = 0;
  for (unsigned i = 0; i < 200; ++i) {
    World world(3000 + i);
    world.add({"path", 0.04, 0.01});
    world.add({"bdpt", 0.02, 0.03});
    analyse(world.study());
    doubted += !world.study().reference.trusted;
  }
  EXPECT_LE(doubted, 1) << "of 200, at a confidence of 99.9 % in two methods at once";
}

TEST(StudyAnalysis, what_cannot_see_is_never_recommended) {
  for (unsigned i = 0; i < 50; ++i) {
    World world(4000 + i);
    StudyOption& blind = world.add({"path", 0.01, 0.001});  // the quickest by far
    blind.state = OptionState::blind, blind.unreachable = {"caustics"};
    world.add({"vcm", 0.04, 0.05, 0, true, 0.75});
    analyse(world.study());
    ASSERT_EQ(world.study().verdicts[0].kind, TargetKind::never);
    ASSERT_EQ(world.study().recommended, 1) << world.study().recommendation;
  }
}

TEST(StudyAnalysis, equals_are_called_equal) {
  int equal = 0, simplest = 0;
  constexpr int studies = 200;
  for (unsigned i = 0; i < studies; ++i) {
    World world(5000 + i);
    world.add({"vcm", 0.08, 0.01});
    world.add({"path", 0.08, 0.01});
    analyse(world.study());
    equal += world.study().equals.size() == 1;
    simplest += world.study().recommended == 1;
  }
  EXPECT_GE(equal, 0.9 * studies - 2.5 * std::sqrt(0.09 * studies)) << "a nominal 90 %";
  EXPECT_GE(simplest, equal);
}

TEST(StudyAnalysis, a_clear_winner_wins) {
  for (unsigned i = 0; i < 50; ++i) {
    World world(6000 + i);
    world.add({"path", 0.16, 0.01});
    world.add({"vcm", 0.01, 0.04});
    analyse(world.study());
    ASSERT_EQ(world.study().recommended, 1);
    ASSERT_TRUE(world.study().equals.empty());
  }
}

TEST(StudyAnalysis, drift_and_load_disturb) {
  World steady(7000), drifting(7001), loaded(7002);
  drifting.drift = [](int k) { return 1 + 0.2 * k / 9; };
  for (World* world : {&steady, &drifting, &loaded}) world->add({"path", 0.08, 0.01});
  loaded.study().machine.foreign_load = 0.2;
  for (World* world : {&steady, &drifting, &loaded}) analyse(world->study());
  EXPECT_TRUE(steady.study().warnings.empty());
  for (World* world : {&drifting, &loaded}) {
    ASSERT_EQ(world->study().warnings.size(), 1u);
    EXPECT_EQ(world->study().warnings[0].rfind("disturbed", 0), 0u);
  }
}

TEST(StudyAnalysis, no_number_is_refused) {
  World world(8000);
  world.add({"path", 0.08, 0.01});
  world.study().options[0].runs[3].rungs[2].relmse = std::nan("");
  EXPECT_THROW(analyse(world.study()), InputError);
  World reference(8001);
  reference.add({"path", 0.08, 0.01});
  reference.study().reference.relmse = std::nan("");
  EXPECT_THROW(analyse(reference.study()), InputError);
}

TEST(StudyAnalysis, an_error_below_the_target_from_the_start) {
  for (double sigma2 : {0.0, 1e-4}) {
    World world(9050);
    world.add({"nee", sigma2, 0.01});
    analyse(world.study());
    const Verdict& v = world.study().verdicts[0];
    EXPECT_EQ(v.kind, TargetKind::measured);
    EXPECT_NEAR(v.seconds, 0.16, 0.01);
    EXPECT_EQ(world.study().recommended, 0) << (v.flags.empty() ? "" : v.flags[0]);
  }
}

TEST(StudyAnalysis, a_floor_above_the_target_is_never_passed) {
  World world(9000);
  StudyOption& option = world.add({"path", 0.01, 0.01, 0.0009});  // 3 % of bias, 2 % asked for
  option.splits.push_back({512, 2e-5, 0.0009, 0.00095});
  analyse(world.study());
  EXPECT_EQ(world.study().verdicts[0].kind, TargetKind::never);
  EXPECT_FALSE(conclusive(world.study()));
}

TEST(StudyAnalysis, a_tiny_budget_is_inconclusive) {
  World world(9100);
  StudyOption& option = world.add({"path", 0.01, 0.01}, 2, 1);
  option.state = OptionState::too_slow;
  analyse(world.study());
  EXPECT_FALSE(conclusive(world.study()));
  EXPECT_NE(world.study().recommendation.find("--budget"), std::string::npos);
}

// The precision axis: quicker and harmless wins, quicker with a floor above the target never does.
TEST(StudyAnalysis, precision) {
  World world(9200);
  world.add_relaxed({"path", 0.08, 0.01});
  world.study().pairs = {{"path", "mad", 256, 1e-12, 1e-11, 0.8, 0.79, 0.81, 3, 0, 5},
                         {"path", "fast", 256, 1e-3, 1.01e-3, 0.5, 0.49, 0.51, 3, 0, 5}};
  analyse(world.study());
  const auto& v = world.study().verdicts;
  EXPECT_NEAR(v[1].seconds / v[0].seconds, 0.8, 1e-12);
  EXPECT_EQ(v[2].kind, TargetKind::never);
  EXPECT_EQ(world.study().recommended, 1) << world.study().recommendation;
}

// Of two relaxed precisions the quicker one wins, though the slower differs from strict as little.
// What every pair saves, but hardly any time at all, is not worth other arithmetic.
TEST(StudyAnalysis, a_hair_is_not_worth_it) {
  World world(9400);
  world.add_relaxed({"path", 0.08, 0.01});
  world.study().pairs = {{"path", "mad", 256, 1e-12, 1e-11, 0.99, 0.97, 0.993, 3, 0, 5},
                         {"path", "fast", 256, 1e-12, 1e-11, 0.98, 0.96, 0.99, 3, 0, 5}};
  analyse(world.study());
  EXPECT_EQ(world.study().recommended, 0) << world.study().recommendation;
  EXPECT_EQ(world.study().equals.size(), 2u);
}

// One precision saves time; another, simpler one overlaps with it, and with strict arithmetic, too.
TEST(StudyAnalysis, what_saves_nothing_is_not_recommended) {
  World world(9500);
  world.add_relaxed({"path", 0.08, 0.01});
  world.study().pairs = {{"path", "mad", 256, 1e-12, 1e-11, 1.02, 0.92, 1.08, 3, 0, 5},
                         {"path", "fast", 256, 1e-12, 1e-11, 0.85, 0.84, 0.94, 3, 0, 5}};
  analyse(world.study());
  EXPECT_EQ(world.study().recommended, 2) << world.study().recommendation;
}

TEST(StudyAnalysis, relaxed_beside_relaxed) {
  World world(9300);
  world.add_relaxed({"path", 0.08, 0.01});
  world.study().pairs = {{"path", "mad", 256, 1e-12, 1e-11, 0.99, 0.97, 1.02, 3, 0},
                         {"path", "fast", 256, 1e-12, 1e-11, 0.9, 0.88, 0.93, 3, 0}};
  analyse(world.study());
  EXPECT_EQ(world.study().recommended, 2) << world.study().recommendation;
  world.study().pairs[1].wrong = 1;
  analyse(world.study());
  EXPECT_NE(world.study().recommended, 2) << "its kernels count what went wrong";
}

// Errors below the target from the first rung on: times are alike, not different by the clock's
// luck.
TEST(StudyAnalysis, equals_from_the_start) {
  int equal = 0;
  constexpr int studies = 100;
  for (unsigned i = 0; i < studies; ++i) {
    World world(9400 + i);
    world.add({"path", 1e-4, 0.01});
    world.add({"vcm", 1e-4, 0.01});
    analyse(world.study());
    equal += world.study().equals.size() == 1;
  }
  EXPECT_GE(equal, 0.9 * studies - 2.5 * std::sqrt(0.09 * studies)) << "a nominal 90 %";
}

TEST(StudyFit, recovers_exact_curves) {
  std::vector<CurvePoint> curve;
  for (double t = 1; t < 100; t *= 2) curve.push_back({t, 0.3 / t + 0.02 / std::sqrt(t)});
  const CurveFit fit = fit_curve(curve, true, 0.75);
  EXPECT_NEAR(fit.noise, 0.3, 1e-9);
  EXPECT_NEAR(fit.bias, 0.02, 1e-9);
  EXPECT_EQ(fit.exponent, 1);
  EXPECT_NEAR(*fit.reaches(0.3 / 200 + 0.02 / std::sqrt(200.0)), 200, 1e-6);
  EXPECT_FALSE(CurveFit().reaches(0.1).has_value());
  EXPECT_FALSE(fit.reaches(0).has_value());
}

}  // namespace
}  // namespace pellucid

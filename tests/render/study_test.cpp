// The stages of a study that render: references that agree or do not, elimination, ladders, pairs.
#include <gtest/gtest.h>

#include <cmath>

#include "integrators/registry.h"
#include "render_harness.h"
#include "study/pairs.h"
#include "study/race.h"
#include "study/reference.h"

namespace pellucid::test {
namespace {

using StudyPicture = std::vector<float>;

/// A scene of 16 x 16 pixels, packed, with what runs of a study share.
struct Ground {
  explicit Ground(const std::string& name) : scene(scene_named(name)) {
    scene.settings.width = scene.settings.height = 16;
    packed = pack_scene(scene, {simd_width_for(test_device().info())});
    stage.options.width = stage.options.height = 16;
    stage.options.max_depth = 4;
  }
  Contender contender(const std::string& method) const {
    return Contender(stage, find_integrator(method), "strict");
  }

  Scene scene;
  PackedScene packed;
  StudyStage stage{test_device(), packed, {}, [] { return false; }};
};

void quiet(const std::string&) {}

TEST(StudyReference, two_voices_that_agree) {
  Ground ground("cornell-box");
  Contender one = ground.contender("path"), other = ground.contender("nee");
  const Reference r = make_reference(one, other, 1, 3, quiet);
  EXPECT_TRUE(r.facts.trusted) << r.facts.doubt;
  EXPECT_LT(r.facts.disagreement, 4.5);
  ASSERT_EQ(r.picture.size(), 16u * 16 * 3);
  EXPECT_GT(r.facts.relmse, 0);
  // Runs of their own are as far from it as their variance and its own say.
  Contender judge = ground.contender("path");
  PictureStack runs;
  for (int k = 0; k < 4; ++k) runs.add(judge.run(100 + std::uint64_t(k), 1024).picture);
  const double distance = weighted_distance(runs.mean(), r.picture, r.weights);
  const double expected = r.facts.relmse + runs.variance(r.weights) / 4;
  EXPECT_NEAR(distance / expected, 1, 0.4) << "variances of 768 values from 4 and 8 runs";
}

// A voice that sees paths of two segments less.
TEST(StudyReference, a_voice_that_lies_is_not_trusted) {
  Ground ground("cornell-box");
  Contender one = ground.contender("path"), other = ground.contender("nee");
  other.options().max_depth = 2;
  const Reference r = make_reference(one, other, 1, 2, quiet);
  EXPECT_FALSE(r.facts.trusted);
  EXPECT_NE(r.facts.doubt.find("disagree"), std::string::npos) << r.facts.doubt;
}

// The straight line through three radii ends near what is right, nearer than the largest of them.
TEST(StudyReference, extrapolation_to_radius_zero) {
  Ground ground("cornell-box");
  const Contender merging = ground.contender("bpm");
  const Reference r = extrapolate_reference(merging, merging.radius(), 1, 6, quiet);
  Contender judge = ground.contender("path");
  const StudyPicture truth = judge.run(99, 4096).picture;
  const double light = energy_of(truth);
  EXPECT_NEAR(energy_of(r.picture) / light, 1, 4.5 * r.facts.energy_error + 0.01);
  Contender fixed = merging;
  fixed.options().radius = merging.radius();
  fixed.options().radius_alpha = 1;
  PictureStack biased;
  for (int k = 0; k < 4; ++k) biased.add(fixed.run(50 + std::uint64_t(k), 256).picture);
  EXPECT_GT(std::abs(energy_of(biased.mean()) / light - 1),
            std::abs(energy_of(r.picture) / light - 1));
  EXPECT_FALSE(r.facts.doubt.empty());
}

// Where light is found by chance alone, a method that merges is the witness: it has a veto.
TEST(StudyReference, a_witness_confirms_or_not) {
  Ground ground("cornell-box");
  Contender lucky = ground.contender("path");
  const Contender witness = ground.contender("vcm");
  const double radius = 0.5 * witness.radius();
  const Reference right = confirm_reference(lucky, "caustics", witness, radius, 1, 4, quiet);
  EXPECT_TRUE(right.facts.trusted) << right.facts.doubt;
  EXPECT_NE(right.facts.doubt.find("caustics"), std::string::npos) << right.facts.doubt;
  lucky.options().max_depth = 2;
  const Reference dark = confirm_reference(lucky, "caustics", witness, radius, 1, 4, quiet);
  EXPECT_FALSE(dark.facts.trusted) << dark.facts.doubt;
}

// Radii as large as the room: three such lie on no straight line, which is seen.
TEST(StudyReference, a_bent_line_is_not_trusted) {
  Ground ground("cornell-box");
  const Contender merging = ground.contender("bpm");
  const Reference r = extrapolate_reference(merging, 8 * merging.radius(), 1, 4, quiet);
  EXPECT_FALSE(r.facts.trusted) << r.facts.doubt;
  EXPECT_NE(r.facts.doubt.find("straight line"), std::string::npos) << r.facts.doubt;
}

// Pilots made by hand: a hundredfold error is left out, a twofold one is not.
TEST(StudyRace, what_is_far_dearer_is_left_out) {
  Ground ground("cornell-box");
  Reference reference;
  reference.picture = StudyPicture(16 * 16 * 3, 1.0f);
  reference.weights = relmse_weights(reference.picture);
  std::vector<Entry> entries;
  for (float deviation : {0.01f, 0.014f, 0.1f}) {
    Entry entry;
    entry.contender = std::make_unique<Contender>(ground.contender("path"));
    entry.asked = true;
    for (int k = 0; k < pilot_runs; ++k) {
      LadderStep step;
      step.rung.seconds = 1 + 0.01 * k;
      step.picture = reference.picture;
      for (std::size_t i = 0; i < step.picture.size(); ++i)
        step.picture[i] += (i % 2 ? deviation : -deviation) * (1 + 0.05f * float(k));
      entry.pilots.push_back(step);
    }
    entries.push_back(std::move(entry));
  }
  eliminate(reference, entries);
  EXPECT_EQ(entries[0].option.state, OptionState::main);
  EXPECT_EQ(entries[1].option.state, OptionState::main);
  EXPECT_EQ(entries[2].option.state, OptionState::pilot);
  EXPECT_NE(entries[2].option.reason.find("100 times dearer"), std::string::npos)
      << entries[2].option.reason;
  EXPECT_EQ(racing(entries).size(), 2u);
}

// Ladders are as long as the time allows; without time nothing races.
TEST(StudyRace, ladders_fill_the_time) {
  Ground ground("cornell-box");
  std::vector<Entry> entries(2);
  for (Entry& entry : entries) {
    entry.contender = std::make_unique<Contender>(ground.contender("path"));
    entry.asked = true;
    entry.contender->run(1, 256);
    entry.contender->run(2, 256);
  }
  const double seconds = 40 * main_runs * entries[0].contender->cost(512);
  plan_ladders(seconds, entries);
  double cost = 0;
  for (const Entry& entry : entries) {
    ASSERT_GE(entry.ladder.size(), 5u);
    for (std::size_t r = 0; r < entry.ladder.size(); ++r)
      EXPECT_EQ(entry.ladder[r], std::uint64_t(SOBOL_BLOCK) << r);
    cost += main_runs * entry.contender->cost(entry.ladder.back());
  }
  EXPECT_LE(cost, seconds);
  EXPECT_GE(cost, 0.2 * seconds) << "rungs double, so half of it may be left for each";
  plan_ladders(0, entries);
  EXPECT_TRUE(racing(entries).empty());
  EXPECT_EQ(entries[0].option.state, OptionState::too_slow);
}

// The same seeds in strict and in relaxed arithmetic: no bias beyond rounding, few paths turn.
TEST(StudyPairs, relaxed_arithmetic_is_near) {
  Ground ground("cornell-box");
  Contender strict = ground.contender("path");
  const StudyPicture mean = strict.run(1, 256).picture;
  // Builds its kernels, which the driver keeps: on a busy machine that alone may take the budget.
  Contender(ground.stage, strict.method(), "mad").run(1, 1);
  const auto pair =
      compare_precision(ground.stage, {&strict, "mad"}, relmse_weights(mean), 5, 8, quiet);
  ASSERT_TRUE(pair.has_value());
  EXPECT_EQ(pair->runs, 5);
  EXPECT_LT(std::abs(pair->bias2), 1e-4) << "1 %";
  EXPECT_LT(pair->divergent_per_million, 1e5);
  EXPECT_LE(pair->time_low, pair->time_ratio);
  EXPECT_LE(pair->time_ratio, pair->time_high);
  EXPECT_FALSE(compare_precision(ground.stage, {&strict, "mad"}, relmse_weights(mean), 5, 0, quiet)
                   .has_value())
      << "no time, no pairs";
}

}  // namespace
}  // namespace pellucid::test

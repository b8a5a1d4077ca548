// What verdicts rest on, on data made by hand: stacks of pictures, tiles, certain biases, documents
// that are not sound.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "base/error.h"
#include "study/analyse.h"
#include "study/fit.h"
#include "study/picture_stack.h"
#include "study/study_json.h"
#include "study/tiles.h"
#include "support/sample_study.h"

namespace pellucid {
namespace {

// Three pictures of one pixel: means, variances and squared bias by hand.
TEST(PictureStack, splits_what_is_known) {
  PictureStack stack;
  stack.add({1, 2, 3});
  stack.add({2, 2, 5});
  stack.add({3, 2, 7});
  EXPECT_EQ(stack.mean(), (Picture{2, 2, 5}));
  const std::vector<double> weights{1, 1, 0.5};
  // Variances 1, 0, 4, weighed and averaged.
  EXPECT_DOUBLE_EQ(stack.variance(weights), (1 + 0 + 0.5 * 4) / 3);
  const Picture reference{2, 1, 5};
  const Split split = stack.split(reference, weights, 0.01);
  EXPECT_DOUBLE_EQ(split.variance, 1);
  // (0 + 1 + 0) / 3, less variance / 3, less the reference's own.
  EXPECT_NEAR(split.bias2, 1.0 / 3 - 1.0 / 3 - 0.01, 1e-15);
  EXPECT_GT(split.bias2_upper90, split.bias2);
}

// Over many stacks of pure noise the bound holds at least as often as it says, and the estimate is
// 0 on the average.
TEST(PictureStack, bound_of_the_bias_holds) {
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  const Picture truth(300, 1.0f);
  const std::vector<double> weights(300, 1.0);
  constexpr int stacks = 400;
  int above = 0;
  double sum = 0, squares = 0;
  for (int i = 0; i < stacks; ++i) {
    PictureStack stack;
    for (int k = 0; k < 10; ++k) {
      Picture p(300);
      for (float& v : p) v = 1.1f + normal(random);  // a bias of 0.1
      stack.add(std::move(p));
    }
    const Split split = stack.split(truth, weights, 0);
    above += split.bias2_upper90 >= 0.01;
    sum += split.bias2 / stacks, squares += split.bias2 * split.bias2 / stacks;
  }
  const double error = std::sqrt((squares - sum * sum) / stacks);
  EXPECT_NEAR(sum, 0.01, 4.5 * error);
  EXPECT_GE(above, 0.86 * stacks) << "of 90 % promised";
}

TEST(PictureStack, black_weighs_nothing) {
  for (double w : relmse_weights(Picture(6, 0.0f))) EXPECT_EQ(w, 0);
  const std::vector<double> weights = relmse_weights({2, 0, 4});  // e = 0.02
  EXPECT_NEAR(weights[0], 1 / (4 + 4e-4), 1e-12);
  EXPECT_NEAR(weights[1], 1 / 4e-4, 1e-6);
}

TEST(StudyTiles, errors_and_energies) {
  const Tiling tiling{10, 9};  // 2 x 2 tiles, three of them cut
  ASSERT_EQ(tiling.count(), 4);
  Picture picture(270, 1.0f), reference(270, 1.0f);
  picture[3 * (8 * 10 + 9)] = 3;  // one channel of the last pixel, in the last tile of 2 x 1 pixels
  PictureStack stack;
  stack.add(picture);
  stack.add(reference);
  const std::vector<double> weights(270, 0.5);
  const std::vector<double> errors = tile_errors(tiling, stack, reference, weights);
  EXPECT_EQ(errors[0], 0);
  EXPECT_EQ(errors[2], 0);
  EXPECT_DOUBLE_EQ(errors[3], 0.5 * 4 / 6 / 2) << "mean of 6 values and of 2 pictures";
  EXPECT_EQ(tile_energies(tiling, reference), (std::vector<double>{192, 48, 24, 6}));
}

// Two stacks of the same kind: the worst of the tiles is rarely below its probability; one tile
// that is off by a sixteenth of its light is found.
TEST(StudyTiles, worst_tile_by_chance_and_by_fault) {
  std::mt19937 random(11);
  std::normal_distribution<float> normal;
  const Tiling tiling{32, 32};
  const auto stack_of = [&](float shift) {
    PictureStack stack;
    for (int k = 0; k < 8; ++k) {
      Picture p(32 * 32 * 3);
      for (float& v : p) v = 1 + 0.1f * normal(random);
      for (int y = 8; y < 16; ++y)
        for (int c = 0; c < 24; ++c) p[std::size_t(3 * (32 * y + 16) + c)] += shift;
      stack.add(std::move(p));
    }
    return stack;
  };
  int rare = 0;
  constexpr int tries = 200;
  for (int i = 0; i < tries; ++i)
    rare += worst_tile(tiling, stack_of(0), stack_of(0)).probability < 0.1;
  EXPECT_LE(rare, 36) << "20 expected at most; 4 standard errors above";
  EXPECT_GE(rare, 4) << "and it is no bound that is never met";
  const TileDifference found = worst_tile(tiling, stack_of(0.0625f), stack_of(0));
  EXPECT_EQ(found.tile, 1 * 4 + 2);
  EXPECT_LT(found.probability, 1e-3);
  EXPECT_GT(worst_tile(tiling, stack_of(0.0625f), stack_of(0), 0.05).probability, 0.01)
      << "a twentieth of its light and of a mean tile's is free";
}

TEST(StudyFit, only_a_certain_bias_counts) {
  EXPECT_EQ(certain_bias(1e-4, 1.5e-4, 10), 0) << "2.8 standard errors of 10 runs";
  EXPECT_EQ(certain_bias(1e-4, 1.2e-4, 10), 1e-4);
  EXPECT_EQ(certain_bias(-1e-4, 1e-4, 10), 0);
  EXPECT_EQ(certain_bias(1e-4, 1.0001e-4, 1), 0);
}

Study with_floor() {
  Study s;
  s.target = 0.02;
  StudyOption option;
  option.integrator = "path";
  for (int k = 0; k < 10; ++k) {
    StudyRun run{std::uint64_t(k), {}};
    for (int r = 0; r < 6; ++r)
      run.rungs.push_back({16u << r, 0.1 * (1 << r), 9e-4 + 1e-3 / (1 << r), 1.0});
    option.runs.push_back(run);
  }
  option.splits.push_back({512, 3e-5, 9e-4, 9.2e-4});
  s.options.push_back(option);
  return s;
}

// A reference that does not know its own noise, or has much of it, condemns nobody.
TEST(StudyAnalysis, floors_need_a_good_reference) {
  Study known = with_floor();
  analyse(known);
  EXPECT_EQ(known.verdicts[0].kind, TargetKind::never);
  Study blurred = with_floor();
  blurred.reference.relmse = 0.2 * 0.02 * 0.02;
  analyse(blurred);
  EXPECT_NE(blurred.verdicts[0].kind, TargetKind::never);
  EXPECT_NE(blurred.warnings[0].find("reference's own noise"), std::string::npos);
  Study unknown = with_floor();
  unknown.reference.variance_known = false;
  analyse(unknown);
  EXPECT_NE(unknown.verdicts[0].kind, TargetKind::never);
}

// One unbiased option that is off may be wrong itself: the reference is not accused.
TEST(StudyAnalysis, one_voice_does_not_accuse_the_reference) {
  Study s = with_floor();
  for (StudyRun& run : s.options[0].runs)
    for (Rung& rung : run.rungs) rung.energy_ratio = 1.02 + 1e-4 * double(run.seed);
  s.reference.energy_error = 1e-4;
  analyse(s);
  EXPECT_TRUE(s.reference.trusted) << s.reference.doubt;
  EXPECT_FALSE(s.verdicts[0].flags.empty());
}

TEST(StudyJson, unknown_words_are_refused) {
  for (const char* key : {"state", "kind"}) {
    nlohmann::json document = study_document(test::sample_study());
    document["options"][0][key] = "perfect";
    try {
      read_study(document, "x.json");
      ADD_FAILURE() << key;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("perfect"), std::string::npos) << error.what();
    }
  }
}

TEST(StudyOption, variants_have_names_of_their_own) {
  StudyOption option;
  option.integrator = "vcm";
  EXPECT_EQ(option.name(), "vcm strict");
  EXPECT_TRUE(option.plain());
  option.radius_factor = 0.5;
  EXPECT_EQ(option.name(), "vcm strict (radius x0.5)");
  EXPECT_FALSE(option.plain());
}

}  // namespace
}  // namespace pellucid

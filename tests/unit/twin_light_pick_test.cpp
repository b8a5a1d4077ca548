// The pick of a light: frequencies are prob_pick, for few and for very many lights (numerics 38).
#include <gtest/gtest.h>

#include "support/statistics.h"
#include "support/test_scenes.h"
#include "support/twin.h"

namespace {

using namespace twin;
using namespace pellucid::test;
using pellucid::Scene;

Scene lights(const std::vector<double>& powers) {
  Scene scene = empty_scene();
  for (double p : powers) scene.lights.push_back(pellucid::PointLight{{0, 0, 1}, pellucid::Rgb(p)});
  return scene;
}

std::vector<double> powers_over(Random& random, int n, double decades) {
  std::vector<double> powers;
  for (int i = 0; i < n; ++i) powers.push_back(std::pow(10.0, random.uniform(0, decades)));
  return powers;
}

uint pick(const TwinScene& twin, Random& random) {
  const uint slot = random.word();
  return light_pick(&twin.data, slot, random.word());
}

TEST(TwinLightPick, FrequenciesAreTheProbabilities) {
  constexpr int n = 4000000;
  Random random(1);
  for (int count : {1, 2, 3, 7, 64, 1000}) {
    const TwinScene twin(lights(powers_over(random, count, 3)));
    std::vector<double> observed(size_t(count), 0.0), expected;
    for (int i = 0; i < n; ++i) ++observed[pick(twin, random)];
    for (const ::Light& light : twin.packed.lights) expected.push_back(double(light.prob_pick) * n);
    if (count == 1) {
      EXPECT_EQ(observed[0], n);
      continue;
    }
    const ChiSquare test = chi_square(observed, expected);
    EXPECT_TRUE(accepted(test, sidak(family_alpha, 8))) << count << ": " << test.describe();
  }
}

/// With 1e5 lights of powers 1e6:1 single frequencies are unseen; lights are counted by class.
TEST(TwinLightPick, WeakLightsAmongVeryMany) {
  constexpr int n = 4000000, classes = 12;
  Random random(2);
  const std::vector<double> powers = powers_over(random, 100000, 6);
  const TwinScene twin(lights(powers));
  std::vector<double> observed(classes, 0.0), expected(classes, 0.0);
  const auto class_of = [&](size_t i) { return size_t(std::log10(powers[i]) * classes / 6); };
  double sum = 0;
  for (size_t i = 0; i < powers.size(); ++i) {
    expected[class_of(i)] += double(twin.packed.lights[i].prob_pick) * n;
    sum += double(twin.packed.lights[i].prob_pick);
  }
  EXPECT_NEAR(sum, 1.0, 1e-6);
  for (int i = 0; i < n; ++i) ++observed[class_of(pick(twin, random))];
  const ChiSquare test = chi_square(observed, expected);
  EXPECT_TRUE(accepted(test, family_alpha)) << test.describe();
  for (int c = 0; c < classes; ++c)
    std::printf("powers 10^%.1f..: %.0f picked, %.1f expected\n", 0.5 * c, observed[size_t(c)],
                expected[size_t(c)]);
}

TEST(TwinLightPick, ZeroPowerIsNeverPicked) {
  Random random(3);
  std::vector<double> powers = powers_over(random, 999, 6);
  for (size_t i = 0; i < powers.size(); i += 2) powers[i] = 0;
  const TwinScene twin(lights(powers));
  for (int i = 0; i < 1000000; ++i) ASSERT_GT(powers[pick(twin, random)], 0.0);
  const uint ends[] = {0u, 1u, 0x80000000u, 0xffffffffu};
  for (uint a : ends)
    for (uint b : ends) EXPECT_GT(powers[light_pick(&twin.data, a, b)], 0.0);
}

TEST(TwinLightPick, EverySlotIsReachable) {
  for (int count : {1, 3, 1000, 99991}) {
    const TwinScene twin(lights(std::vector<double>(size_t(count), 1.0)));
    EXPECT_EQ(light_pick(&twin.data, 0, 0), 0u);
    // A slot begins at ceil(slot 2^32 / count): shares differ by one word, far below prob_pick.
    for (int slot = 1; slot < count; slot += 1 + count / 50) {
      const auto first = uint(((std::uint64_t(slot) << 32) + uint(count) - 1) / uint(count));
      EXPECT_EQ(light_pick(&twin.data, first, 0), uint(slot));
      EXPECT_EQ(light_pick(&twin.data, first - 1, 0), uint(slot - 1));
    }
    EXPECT_EQ(light_pick(&twin.data, 0xffffffffu, 0), uint(count - 1));
  }
}

}  // namespace

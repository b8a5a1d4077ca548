// The film's sums: they do not stall, whatever the order of magnitudes, and drop what is no number.
#include <gtest/gtest.h>

#include "support/test_scenes.h"
#include "support/twin.h"

namespace {

using namespace twin;
using pellucid::test::Random;

/// Twice where a plain float sum of U(0,1) has lost half of its value (numerics 21).
constexpr uint many = 1u << 27;

struct Sum {
  float high = 0, low = 0;
  void add(float x) { sum_add(&high, &low, x); }
  double value() const { return double(high) + low; }
};

TEST(FilmSum, ConstantOne) {
  Sum sum;
  float naive = 0;
  for (uint i = 0; i < many; ++i) sum.add(1.0f), naive += 1.0f;
  EXPECT_EQ(sum.value(), double(many));
  EXPECT_EQ(naive, 16777216.0f) << "the test is long enough for a plain sum to stall";
}

TEST(FilmSum, UniformNumbers) {
  Sum sum;
  double exact = 0;
  uint state = 1;
  for (uint i = 0; i < many; ++i) {
    state = state * 1664525u + 1013904223u;
    const float u = rng_unit(state);
    sum.add(u);
    exact += u;  // sums of multiples of 2^-24 below 2^29 are exact in double
  }
  EXPECT_NEAR(sum.value() / many, exact / many, 1e-6);
  EXPECT_NEAR(sum.value() / exact, 1.0, many * 0x1p-48);  // the bound that film.h states
}

TEST(FilmSum, DimAfterBright) {
  // 1e-2 vanishes beside 2^24 * 1e6 in float; all dim values together are 1e-3 of the sum's digits.
  constexpr uint n = 1u << 24;
  Sum mixed, bright_first;
  for (uint i = 0; i < n; ++i) mixed.add(i % 1024 == 0 ? 1e6f : 1e-2f);
  double exact = 0;
  for (uint i = 0; i < n; ++i) exact += double(i % 1024 == 0 ? 1e6f : 1e-2f);
  EXPECT_NEAR(mixed.value() / exact, 1.0, n * 0x1p-48);  // the bound that film.h states
  for (uint i = 0; i < 1000; ++i) bright_first.add(1e6f);
  const double bright = bright_first.value();
  for (uint i = 0; i < n; ++i) bright_first.add(1e-2f);
  EXPECT_NEAR((bright_first.value() - bright) / (n * double(1e-2f)), 1.0, 1e-4);
}

TEST(FilmSum, OrderOfMagnitudesDoesNotMatter) {
  Random random(1);
  for (int run = 0; run < 1000; ++run) {
    Sum sum;
    double exact = 0;
    for (int i = 0; i < 100; ++i) {
      const float x = float(std::pow(10.0, random.uniform(-10, 10)));
      sum.add(x);
      exact += x;
    }
    ASSERT_NEAR(sum.value() / exact, 1.0, 1e-12);
  }
}

class FilmAccumulate : public ::testing::Test {
 protected:
  void add(float x, float y, float z, float rays = 3) {
    film_accumulate(&pixel, diag.data(), F4{x, y, z, rays});
  }
  FilmPixel pixel{};
  std::vector<uint> diag = std::vector<uint>(DIAG_COUNT, 0);
};

TEST_F(FilmAccumulate, SumsSquaresAndCounts) {
  add(1, 2, 3);
  add(0.5f, 0, 4, 5);
  EXPECT_EQ(pixel.sum.x, 1.5f);
  EXPECT_EQ(pixel.sum.y, 2.0f);
  EXPECT_EQ(pixel.sum.z, 7.0f);
  EXPECT_EQ(pixel.square.x, 1.25f);
  EXPECT_EQ(pixel.square.y, 4.0f);
  EXPECT_EQ(pixel.square.z, 25.0f);
  EXPECT_EQ(pixel.count.x, 2u);
  EXPECT_EQ(pixel.count.y, 8u);
}

TEST_F(FilmAccumulate, DropsAndCountsWhatIsNoRadiance) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  add(1, 1, 1);
  add(nan, 1, 1), add(1, nan, 1), add(1, 1, -nan);
  add(infinity, 1, 1), add(1, -infinity, 1);
  EXPECT_EQ(diag[DIAG_nonfinite], 5u);
  EXPECT_EQ(diag[DIAG_negative], 0u);
  add(-1e-6f, 1, 1), add(1, 1, -1);
  EXPECT_EQ(diag[DIAG_negative], 2u);
  add(0, -0.0f, 0);  // minus zero is black
  EXPECT_EQ(diag[DIAG_negative], 2u);
  // Each dropped sample counts as 0: it stays in the number of iterations.
  EXPECT_EQ(pixel.count.x, 9u);
  EXPECT_EQ(pixel.sum.x, 1.0f);
  EXPECT_EQ(pixel.sum.y, 1.0f);
  EXPECT_EQ(pixel.square.z, 1.0f);
}

TEST_F(FilmAccumulate, RaysCarryIntoTheHighWord) {
  pixel.count.y = 0xfffffffeu;
  add(0, 0, 0, 5);
  EXPECT_EQ(pixel.count.y, 3u);
  EXPECT_EQ(pixel.count.z, 1u);
}

}  // namespace

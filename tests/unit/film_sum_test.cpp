// The film's sums: exact whole numbers, the same bits for any order and any grouping of passes, and
// drops of what is no number.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/test_scenes.h"
#include "support/twin.h"

namespace {

using namespace twin;
using pellucid::test::Random;

constexpr int lsb = -FILM_FRACTION_BITS;  // a scene whose brightest light has radiance 1

__extension__ using Uint128 = unsigned __int128;

long double value_of(const uint* words, int count, int exponent) {
  long double value = 0;
  for (int i = count - 1; i >= 0; --i) value = value * 0x1p32L + words[i];
  return std::ldexp(value, exponent);
}

double sum_of(const FilmPixel& p, int channel = 0) {
  return double(value_of(p.sum[channel], FILM_SUM_WORDS, lsb));
}
double square_of(const FilmPixel& p, int channel = 0) {
  return double(value_of(p.square[channel], FILM_SQUARE_WORDS, 2 * lsb + FILM_SQUARE_DROP));
}

TEST(Wide, AddsAtAnyPlaceWithCarry) {
  Random random(3);
  for (int run = 0; run < 20000; ++run) {
    // 128 bits by hand beside the words.
    Uint128 expected = 0;
    uint words[4] = {};
    for (int i = 0; i < 8; ++i) {
      WideValue v;
      v.mantissa = (ulong{random.word()} << 16) | (random.word() & 0xffffu);  // 48 bits
      v.exponent = int(random.below(76));
      expected += Uint128(v.mantissa) << v.exponent;
      wide_add(words, 4, v);
    }
    for (int i = 0; i < 4; ++i) ASSERT_EQ(words[i], uint(expected >> (32 * i))) << run;
  }
}

TEST(Wide, CarriesThroughAllWords) {
  uint words[4] = {~0u, ~0u, ~0u, 0u};
  wide_add(words, 4, WideValue{1, 0});
  for (int i = 0; i < 3; ++i) EXPECT_EQ(words[i], 0u);
  EXPECT_EQ(words[3], 1u);
}

TEST(Wide, RoundsToTheNearest) {
  EXPECT_EQ(wide_round({5, -1}).mantissa, 3u);  // 2.5: ties go up
  EXPECT_EQ(wide_round({5, -2}).mantissa, 1u);  // 1.25
  EXPECT_EQ(wide_round({7, -2}).mantissa, 2u);  // 1.75
  EXPECT_EQ(wide_round({0xffffff, -24}).mantissa, 1u);
  EXPECT_EQ(wide_round({0xffffff, -25}).mantissa, 0u);
  EXPECT_EQ(wide_round({0xffffff, -500}).mantissa, 0u);
  EXPECT_EQ(wide_round({3, 4}).exponent, 4);
}

TEST(Wide, TakesFloatsApart) {
  Random random(4);
  for (int i = 0; i < 100000; ++i) {
    float x;
    const uint bits = random.word() & 0x7fffffffu;
    if (bits >= 0x7f800000u) continue;
    std::memcpy(&x, &bits, sizeof x);
    const WideValue v = wide_from_float(bits);
    ASSERT_EQ(std::ldexp(double(v.mantissa), v.exponent), double(x));
  }
  EXPECT_EQ(wide_from_float(0x80000000u).mantissa, 0u) << "minus zero is black";
}

TEST(Wide, TopOfASumKeepsThirtyTwoBits) {
  Random random(5);
  for (int run = 0; run < 100000; ++run) {
    uint words[4];
    const unsigned used = 1 + random.below(4);
    for (unsigned i = 0; i < 4; ++i) words[i] = i < used ? random.word() >> random.below(32) : 0u;
    const long double exact = value_of(words, 4, 0);
    const WideValue v = wide_top(words, 4);
    const long double top = std::ldexp((long double)v.mantissa, v.exponent);
    ASSERT_LE(v.mantissa, 0xffffffffu);
    ASSERT_LE(top, exact);
    ASSERT_LE(exact - top, exact * 0x1p-31L);
  }
}

class FilmAccumulate : public ::testing::Test {
 protected:
  FilmAccumulate() { launch.film_lsb = lsb; }
  void add(float x, float y, float z, float rays = 3) {
    film_accumulate(&pixel, diag.data(), launch, F4{x, y, z, rays});
  }
  Launch launch{};
  FilmPixel pixel{};
  std::vector<uint> diag = std::vector<uint>(DIAG_COUNT, 0);
  int flaw_ = 0;
};

TEST_F(FilmAccumulate, SumsSquaresAndCounts) {
  add(1, 2, 3);
  add(0.5f, 0, 4, 5);
  EXPECT_EQ(sum_of(pixel, 0), 1.5);
  EXPECT_EQ(sum_of(pixel, 1), 2.0);
  EXPECT_EQ(sum_of(pixel, 2), 7.0);
  EXPECT_EQ(square_of(pixel, 0), 1.25);
  EXPECT_EQ(square_of(pixel, 1), 4.0);
  EXPECT_EQ(square_of(pixel, 2), 25.0);
  EXPECT_EQ(pixel.count[0], 2u);
  EXPECT_EQ(pixel.count[1], 8u);
}

TEST_F(FilmAccumulate, NeverStalls) {
  constexpr uint many = 1u << 26;  // where a plain float sum of U(0,1) has stalled (numerics 21)
  ulong exact = 0;
  uint state = 1;
  for (uint i = 0; i < many; ++i) {
    state = state * 1664525u + 1013904223u;
    const float u = rng_unit(state);
    exact += ulong(u * 0x1p24f);
    add(u, 0, 0);
  }
  EXPECT_EQ(sum_of(pixel), double(exact) * 0x1p-24) << "every bit of every sample";
}

TEST_F(FilmAccumulate, OrderDoesNotMatter) {
  Random random(6);
  std::vector<float> values;
  for (int i = 0; i < 2000; ++i) values.push_back(float(std::pow(10.0, random.uniform(-14, 9))));
  for (float v : values) add(v, v, v);
  const FilmPixel first = pixel;
  pixel = {};
  std::sort(values.begin(), values.end());
  for (float v : values) add(v, v, v);
  EXPECT_EQ(std::memcmp(&first, &pixel, sizeof pixel), 0);
  EXPECT_EQ(diag[DIAG_film_saturated], 0u);
}

TEST_F(FilmAccumulate, SquaresOfAllMagnitudes) {
  for (double x : {1e-9, 1e-6, 1.0, 1e5, 1e9}) {
    pixel = {};
    for (int i = 0; i < 100; ++i) add(float(x), 0, 0);
    const double exact = 100 * double(float(x)) * double(float(x));
    // A square is rounded to a step of 2^-84: half a step each.
    EXPECT_NEAR(square_of(pixel), exact, exact * 1e-12 + 50 * 0x1p-84) << x;
  }
}

TEST_F(FilmAccumulate, CountsWhatDoesNotFit) {
  add(1e30f, 1, 1);
  EXPECT_EQ(diag[DIAG_film_saturated], 1u);
  EXPECT_LE(sum_of(pixel), std::ldexp(1.0, FILM_SAMPLE_BITS + lsb));
  pixel = {};
  add(1e-14f, 1e-17f, 0);  // the nearest steps of 2^-56
  EXPECT_NEAR(sum_of(pixel, 0), 1e-14, 0x1p-57);
  EXPECT_NEAR(sum_of(pixel, 1), 1e-17, 0x1p-57);
  EXPECT_EQ(diag[DIAG_film_saturated], 1u);
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
  EXPECT_EQ(pixel.count[0], 9u);
  EXPECT_EQ(sum_of(pixel, 0), 1.0);
  EXPECT_EQ(sum_of(pixel, 1), 1.0);
  EXPECT_EQ(square_of(pixel, 2), 1.0);
}

TEST_F(FilmAccumulate, RaysCarryIntoTheHighWord) {
  pixel.count[1] = 0xfffffffeu;
  add(0, 0, 0, 5);
  EXPECT_EQ(pixel.count[1], 3u);
  EXPECT_EQ(pixel.count[2], 1u);
}

TEST_F(FilmAccumulate, BlocksJoinTheSums) {
  const float totals[2] = {6.0f, 10.0f};
  for (float total : totals) {
    wide_add(pixel.block[0], FILM_SUM_WORDS, film_steps(total / 2, lsb, &flaw_));
    wide_add(pixel.block[0], FILM_SUM_WORDS, film_steps(total / 2, lsb, &flaw_));
    film_end_block(&pixel);
    EXPECT_EQ(value_of(pixel.block[0], FILM_SUM_WORDS, lsb), 0);
  }
  EXPECT_EQ(sum_of(pixel), 16.0);
  EXPECT_EQ(square_of(pixel), 136.0);
}

}  // namespace

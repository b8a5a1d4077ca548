// Splats: sums that depend neither on order nor on the kind of atomics, and every way they can go
// wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "cl/device.h"
#include "cl/sources.h"
#include "render/specialise.h"
#include "shared/buffers.h"
#include "shared/limits.h"

namespace pellucid {
namespace {

constexpr uint film_side = 16;
constexpr float splat_scale = 1048576.0f;
constexpr int film_lsb = -FILM_FRACTION_BITS;

/// Channel 0 or 1 of a pixel's sum as a number.
double sum_of(const FilmPixel& p, int channel = 0) {
  double value = 0;
  for (int i = FILM_SUM_WORDS - 1; i >= 0; --i) value = value * 0x1p32 + p.sum[channel][i];
  return std::ldexp(value, film_lsb);
}

struct SplatResult {
  std::vector<uint> words, diag;
  std::vector<FilmPixel> film;  ///< after film_add
};

struct SplatRun {
  bool int64_atomics = true;
  std::size_t group = 64;

  SplatResult operator()(const std::vector<F4>& values) const {
    Device device = Device::open("");
    Specialisation special;
    special.features.set(INTG_SPLAT);
    special.int64_atomics = int64_atomics;
    const std::string prelude = prelude_of(special), options = options_of(special);
    const KernelFiles files;
    Kernel splat =
        device.build("probe_splat", files.expand("passes/probe_splat.cl", prelude), options);
    Kernel add = device.build("film_add", files.expand("passes/film_add.cl", prelude), options);
    SplatResult out;
    out.words.resize(film_side * film_side * SPLAT_WORDS);
    out.diag.resize(DIAG_COUNT);
    out.film.resize(film_side * film_side);
    const Buffer words = device.create_buffer("splats", out.words.size() * sizeof(uint));
    const Buffer diag = device.create_buffer("diag", out.diag.size() * sizeof(uint));
    const Buffer film = device.create_buffer("film", out.film.size() * sizeof(FilmPixel));
    const Buffer samples = device.create_buffer("samples", out.film.size() * sizeof(F4));
    const Buffer input = device.create_buffer("values", values.size() * sizeof(F4), values.data());
    const uint n = static_cast<uint>(values.size());
    Launch launch{};
    launch.width = launch.height = launch.tile_width = launch.tile_height = film_side;
    launch.splat_scale = splat_scale;
    launch.film_lsb = film_lsb;
    splat.set_buffer(0, words), splat.set_buffer(1, diag), splat.set_buffer(2, input);
    splat.set_bytes(3, &n, sizeof n), splat.set_bytes(4, &launch, sizeof launch);
    device.launch(splat, n, group, nullptr);
    device.finish();
    device.read(words, out.words.data(), words.bytes());
    add.set_buffer(0, samples), add.set_buffer(1, film), add.set_buffer(2, words);
    add.set_buffer(3, diag), add.set_bytes(4, &launch, sizeof launch);
    device.launch(add, film_side * film_side, group, nullptr);
    device.finish();
    device.read(diag, out.diag.data(), diag.bytes());
    device.read(film, out.film.data(), film.bytes());
    return out;
  }
};

/// Values over many orders of magnitude; half of them on one pixel, where atomics collide.
std::vector<F4> random_values(std::size_t n) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<float> exponent(-12.0f, 10.0f), pixel(0.0f, film_side * film_side);
  std::vector<F4> values(n);
  for (std::size_t i = 0; i < n; ++i)
    values[i] = F4{std::exp2(exponent(engine)), std::exp2(exponent(engine)),
                   std::exp2(exponent(engine)), i % 2 ? 5.0f : std::floor(pixel(engine))};
  return values;
}

TEST(SplatTest, SumsDoNotDependOnOrderGroupOrAtomics) {
  std::vector<F4> values = random_values(200000);
  const SplatResult first = SplatRun{true, 64}(values);
  std::reverse(values.begin(), values.end());
  EXPECT_EQ(SplatRun({true, 1})(values).words, first.words);
  std::shuffle(values.begin(), values.end(), std::mt19937(3));
  EXPECT_EQ(SplatRun({false, 64})(values).words, first.words);
  EXPECT_EQ(SplatRun({false, 8})(values).words, first.words);
  for (uint d : first.diag) EXPECT_EQ(d, 0u);
}

TEST(SplatTest, SumsAreRight) {
  const std::vector<F4> values = random_values(100000);
  std::vector<double> expected(film_side * film_side, 0.0);
  for (const F4& v : values) expected[std::size_t(v.w)] += v.x;
  const SplatResult result = SplatRun{}(values);
  for (std::size_t p = 0; p < expected.size(); ++p) {
    // Each splat is off by at most half a step, the sum as a float by half an ulp.
    const double bound = 0.5 * double(values.size()) / splat_scale + 6e-8 * expected[p];
    EXPECT_NEAR(sum_of(result.film[p]), expected[p], bound) << p;
  }
}

TEST(SplatTest, WordsCarry) {
  // 2^24 of 1 in a pixel: 2^44 steps, far beyond one word.
  const std::vector<F4> ones(1 << 16, F4{256.0f, 256.0f, 256.0f, 9.0f});
  for (bool int64 : {true, false}) {
    const SplatResult result = SplatRun{int64, 64}(ones);
    EXPECT_EQ(sum_of(result.film[9]), 16777216.0) << int64;
  }
}

TEST(SplatTest, WhatCannotBeAddedIsCounted) {
  const float inf = std::numeric_limits<float>::infinity();
  const std::vector<F4> bad{
      {NAN, 1, 1, 0}, {1, inf, 1, 0}, {1, 1, -1, 0}, {1e30f, 1, 1, 0}, {1, 1, 1, 100000}};
  for (bool int64 : {true, false}) {
    const SplatResult result = SplatRun{int64, 64}(bad);
    EXPECT_EQ(result.diag[DIAG_nonfinite], 2u);
    EXPECT_EQ(result.diag[DIAG_negative], 1u);
    EXPECT_EQ(result.diag[DIAG_splat_saturated], 1u);
    EXPECT_EQ(result.diag[DIAG_splat_outside], 1u);
    EXPECT_LT(sum_of(result.film[0]), 1e30);
    EXPECT_EQ(sum_of(result.film[0], 1), 1.0);
  }
}

// 2^8 of the largest splats leave 64 bits: with 64-bit atomics, in the high word, and by a carry.
TEST(SplatTest, SumsThatOverflowAreCounted) {
  const float largest = SPLAT_FIXED_MAX / splat_scale, step = 1.0f / splat_scale;
  const std::vector<F4> fits(3, F4{largest, largest, 0, 5});
  std::vector<F4> too_many = fits;
  too_many.push_back(F4{largest, 0, 0, 5});
  // 3 2^62 + (2^62 - 2^38) + (2^38 - 2^32) + 2 (2^32 - 2^8): the last comes as a carry from the low
  // word.
  std::vector<F4> by_carry = fits;
  by_carry.push_back(F4{largest - std::ldexp(largest, -24), 0, 0, 5});
  by_carry.push_back(F4{std::ldexp(step, 38) - std::ldexp(step, 32), 0, 0, 5});
  by_carry.push_back(F4{std::ldexp(step, 32) - std::ldexp(step, 8), 0, 0, 5});
  by_carry.push_back(by_carry.back());
  for (bool int64 : {true, false}) {
    EXPECT_EQ((SplatRun{int64, 64}(fits).diag[DIAG_splat_saturated]), 0u) << int64;
    EXPECT_EQ((SplatRun{int64, 64}(too_many).diag[DIAG_splat_saturated]), 1u) << int64;
    EXPECT_EQ((SplatRun{int64, 64}(by_carry).diag[DIAG_splat_saturated]), 1u) << int64;
  }
}

}  // namespace
}  // namespace pellucid

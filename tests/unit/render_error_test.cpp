// The error estimate on made-up films: its groups, its bound, and how often that holds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <random>

#include "base/relmse.h"
#include "render/error_estimate.h"
#include "shared/film_sums.h"

namespace pellucid {
namespace {

constexpr int side = 12;
constexpr int lsb = -FILM_FRACTION_BITS;

/// A pixel's value in one pass; `shared` is normal and the same for all pixels of a pass, as
/// photons are.
using Sampling = std::function<float(std::mt19937_64&, int pixel, int channel, double shared)>;

Film black(std::uint64_t block_size) {
  return Film(side, side, {0, 0, side, side}, lsb, block_size);
}

void add_pass(Film& film, std::mt19937_64& engine, const Sampling& sampling) {
  const std::uint64_t pass = film.passes.count(), block = pass / film.block_size;
  film.select_block(block);
  film.passes.add({pass, pass + 1});
  const double shared = std::normal_distribution<double>()(engine);
  for (std::size_t i = 0; i < film.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const float x = sampling(engine, int(i), c, shared);
      uint bits;
      std::memcpy(&bits, &x, sizeof bits);
      WideValue v = wide_from_float(bits);
      v.exponent -= lsb;
      wide_add(film.pixels[i].block[c], FILM_SUM_WORDS, wide_round(v));
    }
  if (!film.passes.contains(film.block_range(block))) return;
  for (FilmPixel& p : film.pixels) film_end_block(&p);
  film.current.reset();
}

double brightness(int pixel) {
  return 0.2 + double(pixel % side) / side;
}

double relmse(const Film& film) {
  double sum = 0, mean = 0;
  for (int i = 0; i < side * side; ++i) mean += brightness(i) / (side * side);
  for (int i = 0; i < side * side; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double x = film.sums(std::size_t(i)).sum[c] / double(film.passes.count());
      const double d = x - brightness(i), e = RELMSE_EPSILON * mean;
      sum += d * d / (brightness(i) * brightness(i) + e * e);
    }
  return sum / (3 * side * side);
}

/// Until the target or `most` passes; shown at every border.
ErrorEstimate run(Film& film, double target, std::uint64_t most, std::uint64_t seed,
                  const Sampling& sampling) {
  std::mt19937_64 engine(seed);
  ErrorEstimate error(target, film);
  while (film.passes.count() < most && !error.reached()) {
    add_pass(film, engine, sampling);
    if (film.passes.count() == error.border()) error.observe(film);
  }
  error.finish(film);
  return error;
}

/// Lognormal with mean 1.
double lognormal(std::mt19937_64& engine, double sigma) {
  return std::exp(sigma * std::normal_distribution<double>()(engine) - 0.5 * sigma * sigma);
}

float plain(std::mt19937_64& engine, int pixel, int, double) {
  return float(brightness(pixel) * lognormal(engine, 0.5));
}

TEST(ErrorEstimate, LooksAreAtPowersOfTwoWithFourToSixteenGroups) {
  for (const std::uint64_t block : {1, 16}) {
    Film film = black(block);
    const ErrorEstimate error = run(film, 1e-6, 1024, 1, plain);
    std::uint64_t expected = block == 1 ? 16 : 64;
    for (const ErrorLook& look : error.looks()) {
      EXPECT_EQ(look.passes, expected);
      EXPECT_EQ(look.groups, std::min<std::uint64_t>(16, expected / block));
      expected *= 2;
    }
    EXPECT_EQ(expected, 2048u);
    EXPECT_FALSE(error.reached());
  }
}

TEST(ErrorEstimate, ExpectsWhatIndependentValuesHave) {
  Film film = black(1);
  const ErrorEstimate error = run(film, 1e-6, 4096, 1, plain);
  // Var of a lognormal of mean 1; 432 values, so 7 % are one standard deviation of either estimate.
  const double expected = std::expm1(0.25) / 4096;
  const ErrorLook& last = error.looks().back();
  EXPECT_NEAR(last.expected / expected, 1, 0.3);
  EXPECT_GT(last.upper, last.expected);
  EXPECT_LT(last.upper, 3 * last.expected);
  // Of N squares of normal values a third counts; three channels make a pixel.
  EXPECT_NEAR(last.effective / (16 * side * side * 3.0 / 5), 1, 0.3);
}

TEST(ErrorEstimate, GroupsTellWhatPixelsShare) {
  const Sampling sharing = [](std::mt19937_64&, int pixel, int, double shared) {
    return float(brightness(pixel) * std::exp(0.5 * shared - 0.125));
  };
  Film alone = black(1), shared = black(1);
  const ErrorLook few = run(alone, 1e-6, 256, 2, plain).looks().back();
  const ErrorLook one = run(shared, 1e-6, 256, 2, sharing).looks().back();
  EXPECT_LT(few.spread, 0.3);
  EXPECT_GT(one.spread, 0.7) << "one value squared: sqrt(2) of its mean, measured with 16";
  EXPECT_GT(one.upper, 3 * one.expected);
}

TEST(ErrorEstimate, GoesOnFromAFilmWithItsOwnPassesAlone) {
  for (const std::uint64_t begin : {1, 100, 128, 200}) {
    Film film = black(16);
    std::mt19937_64 engine(3);
    while (film.passes.count() < begin) add_pass(film, engine, plain);
    const ErrorEstimate error = run(film, 1e-6, 1024, 4, plain);
    for (const ErrorLook& look : error.looks()) {
      const std::uint64_t size = std::max<std::uint64_t>(16, look.passes / 16);
      const std::uint64_t ours = (look.passes - (begin + size - 1) / size * size) / size;
      EXPECT_EQ(look.groups, ours) << begin << " " << look.passes;
      EXPECT_GE(look.groups, 4u);
    }
    EXPECT_EQ(error.looks().back().passes, 1024u);
    EXPECT_NEAR(error.looks().back().expected * 1024 / std::expm1(0.25), 1, 0.4);
  }
}

TEST(ErrorEstimate, TheEndIsALookToo) {
  Film film = black(1);
  const ErrorEstimate error = run(film, 1e-6, 300, 5, plain);
  EXPECT_EQ(error.looks().back().passes, 300u);
  EXPECT_EQ(error.looks().back().groups, 9u) << "of 32 passes, 12 more in none";
  Film few = black(1);
  EXPECT_TRUE(run(few, 1, 3, 5, plain).looks().empty());
}

TEST(ErrorEstimate, WhatAnEarlierRenderFoundCounts) {
  Film film = black(1);
  run(film, 1e-6, 40, 10, plain);
  ErrorEstimate error(0.1, film);
  error.recall(0.11);
  EXPECT_FALSE(error.reached());
  EXPECT_GT(error.likely_end(summarise(film)), 0u);
  error.recall(0.09);
  EXPECT_TRUE(error.reached());
  error.finish(film);
  EXPECT_TRUE(error.reached()) << "no look without passes";
}

TEST(ErrorEstimate, BlackIsNoEvidence) {
  Film film = black(1);
  const ErrorEstimate error =
      run(film, 1, 64, 6, [](std::mt19937_64&, int, int, double) { return 0.0f; });
  EXPECT_FALSE(error.reached());
  EXPECT_TRUE(std::isinf(error.looks().back().upper));
  EXPECT_EQ(error.likely_end(summarise(film)), 0u);
}

TEST(ErrorEstimate, WithoutNoiseTheFirstLookEnds) {
  Film film = black(16);
  const ErrorEstimate error =
      run(film, 1e-3, 4096, 7,
          [](std::mt19937_64&, int pixel, int, double) { return float(brightness(pixel)); });
  EXPECT_EQ(film.passes.count(), 64u);
  EXPECT_EQ(error.looks().back().upper, 0.0);
}

TEST(ErrorEstimate, LikelyEndIsAPowerOfTwoThatSuffices) {
  Film film = black(1);
  const ErrorEstimate error = run(film, 0.02, 64, 8, plain);
  const std::uint64_t end = error.likely_end(summarise(film));
  const double needed = std::expm1(0.25) / (0.02 * 0.02);  // 710
  EXPECT_EQ(end & (end - 1), 0u);
  EXPECT_GE(double(end), needed);
  EXPECT_LE(double(end), 4 * needed);
}

struct Held {
  int kept = 0, stopped = 0;
  std::vector<double> slack;  ///< upper bound over the true error
};

/// `runs` films until a target that lies anywhere within an octave of passes.
Held coverage(int runs, double error_of_pass, const Sampling& sampling) {
  Held held;
  for (int i = 0; i < runs; ++i) {
    Film film = black(1);
    const double wanted = error_of_pass / std::sqrt(32.0 * std::exp2((i + 0.5) / runs));
    const ErrorEstimate error = run(film, wanted, 2048, std::uint64_t(i), sampling);
    if (!error.reached()) continue;
    ++held.stopped;
    held.kept += relmse(film) <= wanted * wanted;
    held.slack.push_back(error.looks().back().upper / relmse(film));
  }
  std::sort(held.slack.begin(), held.slack.end());
  return held;
}

/// 95 % of n, less three standard deviations of so many runs.
int least_kept(int n) {
  return int(std::floor(0.95 * n - 3 * std::sqrt(n * 0.95 * 0.05)));
}

TEST(ErrorEstimate, HoldsWhereValuesAreIndependent) {
  const Held held = coverage(100, std::sqrt(std::expm1(0.25)), plain);
  EXPECT_EQ(held.stopped, 100);
  EXPECT_GE(held.kept, least_kept(held.stopped));
  EXPECT_LT(held.slack[50], 2.0) << "and not at the price of stopping late";
}

TEST(ErrorEstimate, HoldsWherePixelsShare) {
  const Held held = coverage(50, 0.42, [](std::mt19937_64& engine, int pixel, int, double shared) {
    const double a = pixel % 3 == 0 ? 0.5 : 0.25;
    return float(brightness(pixel) * std::exp(a * shared - 0.5 * a * a) * lognormal(engine, 0.2));
  });
  EXPECT_GE(held.stopped, 40) << "of 50: an error of one degree of freedom is hard to bound";
  EXPECT_GE(held.kept, least_kept(held.stopped));
}

/// A third of a pixel's light comes by one path in 400, so that at first few pixels have any.
float rare(std::mt19937_64& engine, int pixel, int, double) {
  const bool hit = std::uniform_real_distribution<double>()(engine) < 1.0 / 400;
  return float(brightness(pixel) * (hit ? 120.0 : 0.7 * lognormal(engine, 0.3)));
}

TEST(ErrorEstimate, RareBrightPathsDoNotEndARenderEarly) {
  // sd of a pass: sqrt(120^2 / 400) = 6, so the root of relMSE is 53 % after 128 passes.
  const Held held = coverage(40, 3, rare);
  EXPECT_EQ(held.stopped, 40);
  EXPECT_GE(held.kept, least_kept(held.stopped));
  // The film's own variances are fooled: most pixels have met none, the others look bright.
  Film film = black(1);
  const ErrorLook first = run(film, 1e-6, 16, 9, rare).looks().front();
  EXPECT_LT(first.relmse, 0.2 * 36 / 16);
  EXPECT_GT(first.expected, 36.0 / 16);
}

}  // namespace
}  // namespace pellucid

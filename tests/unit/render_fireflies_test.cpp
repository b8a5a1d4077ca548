// Which samples stand out: ranking by what they do to their pixel, dropped ones first.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "render/fireflies.h"
#include "shared/film_sums.h"

namespace pellucid {
namespace {

constexpr int lsb = -20;
constexpr std::uint64_t passes = 8;

/// A row of grey pixels with these samples, one list per pixel.
Film row_of(const std::vector<std::vector<double>>& pixels) {
  const int width = int(pixels.size());
  Film film(width + 4, 9, {3, 2, width, 1}, lsb, 1);
  film.passes.add({10, 10 + passes});
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    for (std::size_t k = 0; k < passes; ++k) {
      const double value = pixels[i][k];
      film_keep_peak(&film.pixels[i], float(value), uint(10 + k));
      const auto steps = std::uint64_t(std::ldexp(value, -lsb));
      for (auto& sum : film.pixels[i].sum) wide_add(sum, FILM_SUM_WORDS, WideValue{steps, 0});
    }
  }
  return film;
}

TEST(Fireflies, AreRankedByWhatTheyDoToTheirPixel) {
  const Film film = row_of({{5, 5, 5, 5, 5, 5, 5, 5},           // a lamp: bright, and no surprise
                            {1, 1, 1, 9, 1, 1, 1, 1},           // + 8 of 1
                            {.5, .5, .5, .5, .5, 8.5, .5, .5},  // + 8 of 0.5
                            {0, 0, 0, 0, 0, 0, 0, 0}});
  const std::vector<Firefly> list = fireflies(film, 10);
  ASSERT_EQ(list.size(), 3u) << "black pixels have none";
  EXPECT_EQ(list[0].x, 5);
  EXPECT_EQ(list[0].y, 2);
  EXPECT_EQ(list[0].pass, 15u);
  // The grey's luminance is 1 up to the roundoff of its weights; dark pixels count as a hundredth
  // of the picture's mean, (40 + 16 + 12) / 32, added in squares.
  constexpr double dark = 0.01 * 68 / 32;
  EXPECT_NEAR(list[0].luminance, 8.5, 1e-6);
  EXPECT_NEAR(list[0].others, 0.5, 1e-6);
  EXPECT_NEAR(list[0].excess, 1 / std::hypot(0.5, dark), 1e-5);
  EXPECT_EQ(list[1].x, 4);
  EXPECT_EQ(list[1].pass, 13u);
  EXPECT_NEAR(list[1].excess, 1 / std::hypot(1.0, dark), 1e-5);
  EXPECT_EQ(list[2].x, 3);
  EXPECT_EQ(list[2].pass, 10u) << "the first of equal ones";
  EXPECT_NEAR(list[2].excess, 0, 1e-6);
  EXPECT_EQ(fireflies(film, 1).size(), 1u);
  EXPECT_EQ(fireflies(film, 1)[0].x, 5);
}

TEST(Fireflies, DroppedSamplesComeFirst) {
  Film film = row_of({{1, 1, 1, 9, 1, 1, 1, 1}, {1, 1, 1, 1, 1, 1, 1, 1}});
  film_keep_peak(&film.pixels[1], PEAK_DROPPED, 16);
  film_keep_peak(&film.pixels[1], PEAK_DROPPED, 12);
  film_keep_peak(&film.pixels[1], 100.0f, 11);
  const std::vector<Firefly> list = fireflies(film, 2);
  ASSERT_EQ(list.size(), 2u);
  EXPECT_TRUE(list[0].dropped);
  EXPECT_EQ(list[0].pass, 12u);
  EXPECT_TRUE(std::isnan(list[0].luminance));
  EXPECT_FALSE(list[1].dropped);
}

}  // namespace
}  // namespace pellucid

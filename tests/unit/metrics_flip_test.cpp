// FLIP against closed forms and published numbers; tests/cli/flip_test.py has an implementation of
// its own to compare with.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "base/error.h"
#include "image/flip.h"
#include "image/flip_filters.h"
#include "image/tonemap.h"

namespace pellucid {
namespace {

constexpr float NaN = std::numeric_limits<float>::quiet_NaN();

Image plain(std::array<float, 3> colour, int width = 24, int height = 20) {
  Image image;
  image.width = width;
  image.height = height;
  image.channels = {"R", "G", "B"};
  for (int i = 0; i < width * height; ++i)
    image.data.insert(image.data.end(), colour.begin(), colour.end());
  return image;
}

Image noise(unsigned seed, float scale = 1, int width = 40, int height = 70) {
  Image image = plain({0, 0, 0}, width, height);
  std::mt19937 random(seed);
  for (float& v : image.data) v = scale * float(random() % 1000) / 1000;
  return image;
}

double flip_of(const Image& a, const Image& b) {
  return mean_of_map(flip_map(a, b));
}

TEST(Flip, FiltersHaveThePapersRadiiAndSums) {
  const flip::SpatialFilter spatial(FLIP_PPD);
  EXPECT_NEAR(FLIP_PPD, 67.0206, 1e-4);
  EXPECT_EQ(spatial.radius(), 10);  // ceil(3 sqrt(0.04 / 2 pi^2) 67.02 = 9.05)
  for (std::size_t c = 0; c < 3; ++c) {
    double sum = 0;
    for (int y = -10; y <= 10; ++y)
      for (int x = -10; x <= 10; ++x) sum += spatial.at(c, x, y);
    EXPECT_NEAR(sum, 1, 1e-12);
    const double pi = std::acos(-1.0), step = 1 / (FLIP_PPD * FLIP_PPD);
    const auto csf = [&](double r2) {  // the paper's equation, table 1
      if (c == 0) return std::exp(-pi * pi * r2 / 0.0047);
      if (c == 1) return std::exp(-pi * pi * r2 / 0.0053);
      return 34.1 * std::sqrt(pi / 0.04) * std::exp(-pi * pi * r2 / 0.04) +
             13.5 * std::sqrt(pi / 0.025) * std::exp(-pi * pi * r2 / 0.025);
    };
    EXPECT_NEAR(spatial.at(c, 1, 2) / spatial.at(c, 0, 0), csf(5 * step) / csf(0), 1e-12);
  }
  const flip::FeatureFilter feature(FLIP_PPD);
  EXPECT_EQ(feature.radius(), 9);  // ceil(3 * 0.041 * 67.02 = 8.24)
  for (const flip::Kernel* k : {&feature.edge(), &feature.point()}) {
    double above = 0, below = 0;
    for (const double w : *k) (w > 0 ? above : below) += w;
    EXPECT_NEAR(above, 1, 1e-12);
    EXPECT_NEAR(below, -1, 1e-12);
  }
}

TEST(Flip, IdenticalIsZeroAndNothingElseIs) {
  EXPECT_EQ(flip_of(noise(1), noise(1)), 0.0);
  EXPECT_GT(flip_of(noise(1), noise(2)), 0.1);
  EXPECT_EQ(mean_of_map(hdr_flip_map(noise(1, 50), noise(1, 50))), 0.0);
}

TEST(Flip, PlainColoursAreTheColourMetricAlone) {
  const Image black = plain({0, 0, 0}), white = plain({1, 1, 1});
  // Hunt-adjusted CIELAB of green is (87.73, -75.62, 72.98), of blue (32.30, 25.58, -34.85), to the
  // digits that tables of CIELAB (87.73 -86.19 83.18; 32.30 79.19 -107.86) give; their distance,
  // to 0.7, is the largest there is. Black to white is 100 in lightness.
  const double most = std::pow(87.735 - 32.297 + std::hypot(75.62 + 25.58, 72.98 + 34.84), 0.7);
  const double knee = 0.4 * most, distance = std::pow(100.0, 0.7);
  EXPECT_NEAR(flip_of(black, white), 0.95 + 0.05 * (distance - knee) / (most - knee), 1e-4);
  EXPECT_NEAR(flip_of(plain({0, 1, 0}), plain({0, 0, 1})), 1, 1e-6);
  // Two greys, by L* = 116 cbrt(Y) - 16.
  const double lightness = 116 * (std::cbrt(0.5) - std::cbrt(0.4));
  EXPECT_NEAR(flip_of(plain({0.5f, 0.5f, 0.5f}), plain({0.4f, 0.4f, 0.4f})),
              0.95 / knee * std::pow(lightness, 0.7), 1e-4);
}

TEST(Flip, IsSymmetricAndTurnsWithThePicture) {
  const Image a = noise(3), b = noise(4);
  EXPECT_EQ(flip_map(a, b).data, flip_map(b, a).data);
  const auto turned = [](const Image& image) {  // by half a turn
    Image t = image;
    const std::size_t n = image.channels.size(), pixels = image.data.size() / n;
    for (std::size_t p = 0; p < pixels; ++p)
      for (std::size_t c = 0; c < n; ++c) t.data[p * n + c] = image.data[(pixels - 1 - p) * n + c];
    return t;
  };
  const Image one = flip_map(a, b), two = turned(flip_map(turned(a), turned(b)));
  for (std::size_t i = 0; i < one.data.size(); ++i) EXPECT_NEAR(one.data[i], two.data[i], 1e-6);
}

TEST(Flip, RangeEndsAtWhatScreensShow) {
  EXPECT_EQ(flip_of(plain({7, 7, 7}), plain({1, 1, 1})), 0.0);
  EXPECT_EQ(flip_of(plain({-7, 0, 0}), plain({0, 0, 0})), 0.0);
  EXPECT_GT(mean_of_map(hdr_flip_map(plain({7, 7, 7}), plain({1, 1, 1}))), 0.1);
}

TEST(Flip, GreyImagesAreThreeEqualColours) {
  Image a = plain({0.2f, 0.2f, 0.2f}), b = plain({0.3f, 0.3f, 0.3f}), grey_a = a, grey_b = b;
  for (Image* image : {&grey_a, &grey_b}) {
    image->channels = {"Y"};
    image->data.resize(image->data.size() / 3);
  }
  EXPECT_EQ(flip_map(a, b).data, flip_map(grey_a, grey_b).data);
}

TEST(Flip, WhatIsNotFiniteIsMarkedAndStaysAlone) {
  Image a = noise(5);
  const Image b = noise(6);
  a.data[3 * 100] = NaN;
  const Image map = flip_map(a, b);
  for (std::size_t i = 0; i < map.data.size(); ++i) EXPECT_EQ(std::isnan(map.data[i]), i == 100);
  EXPECT_TRUE(std::isnan(mean_of_map(map)));
}

TEST(HdrFlip, ExposuresShowTheBrightestAndTheMedian) {
  Image reference = plain({0.25f, 0.25f, 0.25f}, 3, 1);
  for (std::size_t c = 0; c < 3; ++c) reference.data[c] = 64;
  const ExposureRange range = flip_exposures(reference);
  const auto shown = [](double x) {  // the curve of the paper: exposure 0.6 before the fit
    return double(srgb_decode(display_value(float(0.6 * x), {ToneCurve::filmic, 0})));
  };
  EXPECT_NEAR(shown(64 * std::exp2(range.start)), 0.85, 1e-5);
  EXPECT_NEAR(shown(0.25 * std::exp2(range.stop)), 0.85, 1e-5);
  EXPECT_NEAR(range.stop - range.start, 8, 1e-12);
  EXPECT_EQ(range.count, 8);
  EXPECT_EQ(range.at(0), range.start);
  EXPECT_DOUBLE_EQ(range.at(7), range.stop);
  EXPECT_EQ(flip_exposures(plain({0, 0, 0})).count, 1);
  // The example of the authors has 14 exposures, from -12.5423 to 0.9427.
  for (std::size_t c = 0; c < 3; ++c) reference.data[c] = float(0.25 * std::exp2(12.5423 + 0.9427));
  EXPECT_EQ(flip_exposures(reference).count, 14);
  // More than half black: the median of the rest.
  Image spot = plain({0, 0, 0}, 5, 1);
  for (std::size_t c = 0; c < 3; ++c) spot.data[c] = 2;
  EXPECT_EQ(flip_exposures(spot).start, flip_exposures(spot).stop);
}

TEST(HdrFlip, IsTheWorstExposureAndKnowsNoUnit) {
  const Image a = noise(7, 30), b = noise(8, 30);
  Image dim_a = a, dim_b = b;
  for (float& v : dim_a.data) v /= 1024;
  for (float& v : dim_b.data) v /= 1024;
  EXPECT_NEAR(mean_of_map(hdr_flip_map(a, b)), mean_of_map(hdr_flip_map(dim_a, dim_b)), 1e-6);
  // Clipped, both are the same white; tone-mapped at some exposure they are not.
  const Image white_a = plain({9, 9, 9}), white_b = plain({5, 5, 5});
  EXPECT_GT(mean_of_map(hdr_flip_map(white_a, white_b)), flip_of(white_a, white_b) + 0.1);
}

TEST(Flip, SizesMustBeEqual) {
  EXPECT_THROW(flip_map(plain({0, 0, 0}, 3, 4), plain({0, 0, 0}, 4, 3)), InputError);
}

}  // namespace
}  // namespace pellucid

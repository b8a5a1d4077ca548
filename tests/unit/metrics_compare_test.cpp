// Metrics against values worked out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "image/metrics.h"
#include "image/tonemap.h"

namespace pellucid {
namespace {

Image grey(int width, int height, std::vector<float> data) {
  Image image;
  image.width = width;
  image.height = height;
  image.channels = {"Y"};
  image.data = std::move(data);
  return image;
}

Image rgb(int width, int height, float value) {
  Image image;
  image.width = width;
  image.height = height;
  image.channels = {"R", "G", "B"};
  image.data.assign(std::size_t(width) * std::size_t(height) * 3, value);
  return image;
}

TEST(Metrics, HandComputedPair) {
  // Differences 1 and -2; mean of the reference 3, so e = 0.03.
  const ImageError error = compare_images(grey(2, 1, {3, 2}), grey(2, 1, {2, 4}));
  const double e2 = 0.03 * 0.03;
  EXPECT_EQ(error.nonfinite, 0u);
  EXPECT_DOUBLE_EQ(error.mse, 2.5);
  EXPECT_DOUBLE_EQ(error.rmse, std::sqrt(2.5));
  EXPECT_DOUBLE_EQ(error.relmse, 0.5 * (1 / (4 + e2) + 4 / (16 + e2)));
  EXPECT_DOUBLE_EQ(error.smape, 0.5 * (2 / 5.03 + 4 / 6.03));
  EXPECT_DOUBLE_EQ(error.energy_ratio, 5.0 / 6.0);
  EXPECT_DOUBLE_EQ(error.p95_tile_relmse, error.relmse);  // a single tile
}

TEST(Metrics, OnePercentOffIsOnePercent) {
  const ImageError error = compare_images(rgb(20, 20, 1.01f), rgb(20, 20, 1.0f));
  EXPECT_NEAR(std::sqrt(error.relmse), 0.01, 1e-6);
  EXPECT_NEAR(error.energy_ratio, 1.01, 1e-6);
}

TEST(Metrics, ExposureChangesNoRelativeError) {
  const ImageError one = compare_images(grey(2, 1, {3, 2}), grey(2, 1, {2, 4}));
  const ImageError two = compare_images(grey(2, 1, {3e6f, 2e6f}), grey(2, 1, {2e6f, 4e6f}));
  EXPECT_NEAR(one.relmse, two.relmse, 1e-12);
  EXPECT_NEAR(one.smape, two.smape, 1e-12);
}

TEST(Metrics, OrderOfChannelsAndOthersDoNotMatter) {
  Image a = rgb(1, 1, 0), b = rgb(1, 1, 0);
  a.data = {1, 2, 3};
  b.channels = {"Z", "B", "G", "R"};
  b.data = {std::numeric_limits<float>::infinity(), 3, 2, 1};
  EXPECT_EQ(compare_images(a, b).mse, 0.0);
  EXPECT_EQ(compare_images(a, b).nonfinite, 0u);
}

TEST(Metrics, NonFiniteIsCountedByPixelAndNothingElseIsTold) {
  Image a = rgb(4, 1, 1), b = rgb(4, 1, 1);
  a.data[0] = a.data[1] = std::numeric_limits<float>::quiet_NaN();
  b.data[5] = std::numeric_limits<float>::infinity();
  const ImageError error = compare_images(a, b);
  EXPECT_EQ(error.nonfinite, 2u);
  for (const double value : {error.mse, error.rmse, error.relmse, error.smape, error.energy_ratio,
                             error.p95_tile_relmse})
    EXPECT_TRUE(std::isnan(value));
}

TEST(Metrics, EqualInfinitiesAreNotEqual) {
  const Image a = grey(1, 1, {std::numeric_limits<float>::infinity()});
  EXPECT_EQ(compare_images(a, a).nonfinite, 1u);
}

TEST(Metrics, BlackEqualsItselfButNothingElseEqualsBlack) {
  const ImageError same = compare_images(rgb(2, 2, 0), rgb(2, 2, 0));
  EXPECT_EQ(same.relmse, 0.0);
  EXPECT_EQ(same.smape, 0.0);
  EXPECT_EQ(same.energy_ratio, 1.0);
  const ImageError other = compare_images(rgb(2, 2, 1), rgb(2, 2, 0));
  EXPECT_TRUE(std::isinf(other.relmse));
  EXPECT_TRUE(std::isinf(other.energy_ratio));
}

TEST(Metrics, P95IsTheNearestRankOfTiles) {
  // 20 tiles in a row, tile t is off by t+1 everywhere: rank ceil(0.95 * 20) is tile 18, off by 19.
  Image a = grey(320, 16, {}), b = grey(320, 16, {});
  b.data.assign(320 * 16, 100.0f);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 320; ++x) a.data.push_back(100.0f + static_cast<float>(x / 16 + 1));
  EXPECT_NEAR(compare_images(a, b).p95_tile_relmse, 19.0 * 19.0 / (100.0 * 100.0 + 1.0), 1e-12);
}

TEST(Metrics, WorstTileIsFoundAndGoodOnesAreCounted) {
  Image a = grey(64, 32, std::vector<float>(64 * 32, 1.0f));
  const Image b = a;
  for (int y = 16; y < 32; ++y)
    for (int x = 16; x < 48; ++x) a.data[std::size_t(y * 64 + x)] = x < 32 ? 1.009f : 1.5f;
  const ImageError error = compare_images(a, b);
  EXPECT_NEAR(error.worst_tile_relmse, 0.25 / 1.0001, 1e-12);
  EXPECT_EQ(error.worst_tile.x0, 32);
  EXPECT_EQ(error.worst_tile.y0, 16);
  EXPECT_EQ(error.worst_tile.x1, 48);
  EXPECT_DOUBLE_EQ(error.tiles_within_1pct, 7.0 / 8);
}

TEST(Metrics, TrimmingDropsTheLargestThousandth) {
  Image a = grey(1000, 2, std::vector<float>(2000, 1.1f));
  const Image b = grey(1000, 2, std::vector<float>(2000, 1.0f));
  a.data[5] = a.data[1500] = 1000;  // two of two thousand
  const ImageError error = compare_images(a, b);
  EXPECT_GT(error.relmse, 900);
  EXPECT_NEAR(error.trimmed_relmse, 0.01 / 1.0001, 1e-8);
  a.data[7] = 11;  // the third stays
  EXPECT_NEAR(compare_images(a, b).trimmed_relmse, (1997 * 0.01 + 100) / 1998 / 1.0001, 1e-8);
  EXPECT_DOUBLE_EQ(compare_images(grey(2, 1, {3, 2}), grey(2, 1, {2, 4})).trimmed_relmse,
                   compare_images(grey(2, 1, {3, 2}), grey(2, 1, {2, 4})).relmse);
}

TEST(Metrics, EnergyOfChannelsCannotHideBehindEachOther) {
  Image a = rgb(2, 2, 1), b = rgb(2, 2, 1);
  for (std::size_t i = 0; i < a.data.size(); i += 3) {
    a.data[i] = 0.75f;
    a.data[i + 1] = 1.25f;
  }
  const ImageError error = compare_images(a, b);
  EXPECT_DOUBLE_EQ(error.energy_ratio, 1);
  EXPECT_EQ(error.channel_energy, (std::vector<double>{0.75, 1.25, 1}));
  EXPECT_DOUBLE_EQ(error.worst_channel_energy, 0.75);
}

TEST(Metrics, FirefliesStickOutOfTheHighestThousandth) {
  Image a = grey(1000, 2, std::vector<float>(2000, 2.0f));
  const Image b = a;
  EXPECT_DOUBLE_EQ(compare_images(a, b).firefly_index, 1);
  a.data[77] = 50;
  EXPECT_DOUBLE_EQ(compare_images(a, b).firefly_index, 25);
  EXPECT_DOUBLE_EQ(compare_images(a, b).reference_firefly_index, 1);
  EXPECT_DOUBLE_EQ(compare_images(b, a).reference_firefly_index, 25);
}

TEST(Metrics, SignedMapHasTheSignOfTheError) {
  const Image map = signed_map(grey(3, 1, {3, 2, NAN}), grey(3, 1, {2, 4, 1}));
  EXPECT_NEAR(map.data[0], 1.0 / std::sqrt(4.0009), 1e-6);
  EXPECT_NEAR(map.data[1], -2.0 / std::sqrt(16.0009), 1e-6);
  EXPECT_TRUE(std::isnan(map.data[2]));
}

TEST(Metrics, TilesAtTheBorderAreMeansOfFewerPixels) {
  Image a = grey(17, 1, std::vector<float>(17, 1.0f));
  const Image b = a;
  a.data[16] = 2.0f;  // alone in the second tile
  EXPECT_NEAR(compare_images(a, b).p95_tile_relmse, 1.0 / 1.0001, 1e-12);
}

TEST(Metrics, RefusesWhatCannotBeCompared) {
  EXPECT_THROW(compare_images(rgb(2, 1, 0), rgb(1, 2, 0)), InputError);
  EXPECT_THROW(compare_images(rgb(1, 1, 0), grey(1, 1, {0})), InputError);
  Image odd = grey(1, 1, {0, 0});
  odd.channels = {"u", "v"};
  EXPECT_THROW(compare_images(odd, odd), InputError);
}

TEST(Metrics, ErrorMapIsTheRootOfThePixelsOwnRelMse) {
  const Image a = grey(3, 1, {3, 2, NAN}), b = grey(3, 1, {2, 4, 1});
  const Image map = error_map(a, b);  // e = 0.03 over the finite pixels
  EXPECT_NEAR(map.data[0], 1.0 / std::sqrt(4.0009), 1e-6);
  EXPECT_NEAR(map.data[1], 2.0 / std::sqrt(16.0009), 1e-6);
  EXPECT_TRUE(std::isnan(map.data[2]));
}

TEST(Tonemap, CurveIsTheStandardsAndItsOwnInverse) {
  EXPECT_NEAR(srgb_encode(0.18f), 0.46136f, 1e-5f);
  EXPECT_NEAR(srgb_encode(0.001f), 0.01292f, 1e-7f);
  for (int i = 0; i <= 255; ++i) {
    const float encoded = static_cast<float>(i) / 255.0f;
    EXPECT_NEAR(srgb_encode(srgb_decode(encoded)), encoded, 1e-6f);
  }
}

TEST(Tonemap, ClipsAndTakesNanForBlack) {
  EXPECT_EQ(srgb_encode(-1.0f), 0.0f);
  EXPECT_EQ(srgb_encode(5.0f), 1.0f);
  EXPECT_EQ(srgb_encode(NAN), 0.0f);
  EXPECT_EQ(srgb_encode(INFINITY), 1.0f);
}

TEST(Tonemap, FalseColoursKeepTheirScale) {
  const Image map = grey(7, 1, {0.0f, 1e-3f, 1e-1f, 1.0f, 10.0f, INFINITY, NAN});
  const std::vector<float> c = false_colour(map).data;
  const auto colour = [&](std::size_t i) { return std::vector<float>(&c[3 * i], &c[3 * i] + 3); };
  EXPECT_EQ(colour(0), (std::vector<float>{0, 0, 0}));
  EXPECT_NEAR(colour(1)[2], 0.0f, 1e-5f);
  EXPECT_NEAR(colour(2)[0], 0.9f, 1e-5f);
  EXPECT_NEAR(colour(3)[1], 0.9f, 1e-5f);
  EXPECT_EQ(colour(4), (std::vector<float>{1, 1, 1}));
  EXPECT_EQ(colour(5), (std::vector<float>{1, 1, 1}));
  EXPECT_EQ(colour(6), (std::vector<float>{0, 1, 0}));
}

TEST(Tonemap, SignedColoursAreWhiteInTheMiddleAndMirrored) {
  using Rgb = std::vector<float>;
  const auto colour = [](float value, ErrorScale scale) {
    return false_colour(grey(1, 1, {value}), scale).data;
  };
  for (const ErrorScale scale : {ErrorScale::signed_relative, ErrorScale::deviations}) {
    EXPECT_EQ(colour(0, scale), (Rgb{1, 1, 1}));
    EXPECT_EQ(colour(9, scale), (Rgb{0.5f, 0, 0}));
    EXPECT_EQ(colour(-9, scale), (Rgb{0, 0.1f, 0.5f}));
    EXPECT_EQ(colour(NAN, scale), (Rgb{0, 1, 0}));
  }
  EXPECT_EQ(colour(5e-4f, ErrorScale::signed_relative), (Rgb{1, 1, 1}));
  EXPECT_NEAR(colour(-std::pow(10.0f, -1.5f), ErrorScale::signed_relative)[2], 0.9f, 1e-5f);
  EXPECT_NEAR(colour(2.5f, ErrorScale::deviations)[0], 0.9f, 1e-6f);
  EXPECT_NEAR(colour(0.5f, ErrorScale::perceived)[0], 0.716387f, 1e-6f);  // magma's middle
  EXPECT_EQ(colour(0, ErrorScale::perceived)[2], 0.013866f);
}

}  // namespace
}  // namespace pellucid

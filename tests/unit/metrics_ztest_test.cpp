// The statistical gate on synthetic pictures whose noise and difference are known.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/error.h"
#include "image/ztest.h"

namespace pellucid {
namespace {

/// How pictures are made: each pixel's mean is `level`, samples deviate by `cv` times it.
struct Noisy {
  int width = 64, height = 48;
  double level = 1, cv = 1, samples = 64;
  int blocks = 4;       ///< whose spread gives the stored variance
  double shared = 0;    ///< part of the variance that neighbours in a tile have in common
  double tile_off = 0;  ///< factor - 1 of the tile at (16, 16)
};

/// Gaussian sums of blocks: means of pixels and the measured variances of these.
Image make(const Noisy& n, unsigned seed) {
  Image image;
  image.width = n.width;
  image.height = n.height;
  image.channels = {"R", "G", "B", "variance.R", "variance.G", "variance.B"};
  image.data.resize(std::size_t(n.width * n.height * 6));
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const double sd = n.level * n.cv * std::sqrt(n.blocks / n.samples);  // of a block's mean
  std::vector<double> common(std::size_t(n.width * n.height));         // by tile and block
  for (double& v : common) v = normal(random);
  for (int y = 0; y < n.height; ++y)
    for (int x = 0; x < n.width; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        const int tile = (y / TILE) * n.width + (x / TILE) * n.blocks;
        double sum = 0, squares = 0;
        for (int b = 0; b < n.blocks; ++b) {
          const double v = n.level + sd * (std::sqrt(1 - n.shared) * normal(random) +
                                           std::sqrt(n.shared) * common[std::size_t(tile + b)]);
          sum += v;
          squares += v * v;
        }
        const double mean = sum / n.blocks;
        const bool in_tile = x / TILE == 1 && y / TILE == 1;
        float* pixel = &image.data[std::size_t(y * n.width + x) * 6];
        pixel[c] = float(mean * (in_tile ? 1 + n.tile_off : 1));
        pixel[3 + c] =
            float(std::max(0.0, squares - n.blocks * mean * mean) / (n.blocks - 1) / n.blocks);
      }
  return image;
}

ZTest compare(const Noisy& a, const Noisy& b, unsigned seed, bool independent = true,
              ZTestLimits limits = {}) {
  const Image image_a = make(a, 2 * seed), image_b = make(b, 2 * seed + 1);
  return z_test({{&image_a}, a.samples, independent}, {{&image_b}, b.samples, independent}, limits);
}

TEST(ZTest, EqualPicturesAreCalledDifferentAtTheNominalRate) {
  // At 5 % in 600 pairs: 30 +- 5.3 if tests were exact. Channels here are independent, so that
  // Bonferroni is nearly exact; three deviations either way.
  for (const int blocks : {2, 8}) {
    Noisy n;
    n.width = 32;
    n.height = 16;
    n.blocks = blocks;
    n.samples = 16 * blocks;
    ZTestLimits limits;
    limits.alpha = 0.05;
    int different = 0;
    for (unsigned seed = 0; seed < 600; ++seed)
      different += compare(n, n, seed, true, limits).verdict == Verdict::different;
    EXPECT_NEAR(different, 30, 16) << blocks << " blocks";
  }
}

TEST(ZTest, QuietEqualPicturesPassAndOnePercentIsSeen) {
  Noisy n;
  n.samples = 1024;
  Noisy brighter = n;
  brighter.level = 1.01;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const ZTest same = compare(n, n, seed);
    EXPECT_EQ(same.verdict, Verdict::equal) << same.reason;
    EXPECT_LT(same.detectable_image, 0.005);
    EXPECT_EQ(same.tiles_judged, same.tiles);
    const ZTest off = compare(brighter, n, seed);
    EXPECT_EQ(off.verdict, Verdict::different);
    EXPECT_NEAR(off.image.difference, 0.01, 0.005);
    EXPECT_GT(off.image.z, off.image.threshold);
  }
}

TEST(ZTest, OneTileThatIsOffIsNamed) {
  Noisy n, off;
  n.samples = off.samples = 1024;
  off.tile_off = -0.04;  // of 12 tiles: a third of a percent of the whole
  const ZTest test = compare(off, n, 3);
  EXPECT_EQ(test.verdict, Verdict::different);
  EXPECT_EQ(test.tile.where.x0, 16);
  EXPECT_EQ(test.tile.where.y0, 16);
  EXPECT_LT(test.tile.z, -test.tile.threshold);
  EXPECT_NEAR(test.tile.difference, -0.04, 0.01);
}

TEST(ZTest, NoiseIsNoExcuse) {
  Noisy n;
  n.samples = 32;  // a picture of 3072 pixels: 1 / sqrt(3072 * 32) * sqrt(2) * (4 + 1.6) = 2.6 %
  const ZTest test = compare(n, n, 5);
  EXPECT_EQ(test.verdict, Verdict::inconclusive);
  EXPECT_NEAR(test.detectable_image, 0.026, 0.004);
  EXPECT_NE(test.reason.find("picture's energy"), std::string::npos);
  ZTestLimits wide;
  wide.image = 0.05;
  wide.tile = 0.5;
  EXPECT_EQ(compare(n, n, 5, true, wide).verdict, Verdict::equal);
  wide.tile = 0.05;
  const ZTest tile = compare(n, n, 5, true, wide);
  EXPECT_EQ(tile.verdict, Verdict::inconclusive);
  EXPECT_NE(tile.reason.find("tile's energy"), std::string::npos);
}

TEST(ZTest, DetectableIsWhatIsDetectedInNineteenOfTwenty) {
  Noisy n;
  n.width = n.height = 32;
  n.samples = 768;  // so that the unknown true mean of the scale is known to 0.1 %
  const double detectable = compare(n, n, 1).image.detectable;
  Noisy off = n;
  off.level = 1 + detectable;
  int image = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    // One channel's chance is 95 %; any of three independent ones is found nearly always, so only
    // the first channel is made different here.
    Image a = make(off, 2 * seed + 1000), b = make(n, 2 * seed + 1001);
    const Image same = make(n, 2 * seed + 1000);
    for (std::size_t i = 0; i < a.data.size(); ++i)
      if (i % 6 % 3 != 0) a.data[i] = same.data[i];
    image += z_test({{&a}, n.samples, true}, {{&b}, n.samples, true}).image.differs();
  }
  EXPECT_NEAR(image / 400.0, 0.95,
              3 * std::sqrt(0.95 * 0.05 / 400) + 0.005);  // and 0.5 % for that scale
}

TEST(ZTest, DependentPixelsAreGivenNoCredit) {
  Noisy n;
  n.samples = 1024;
  n.shared = 0.8;
  n.blocks = 64;
  n.width = n.height = 32;
  ZTestLimits limits;
  limits.alpha = 0.05;
  int wrong = 0, right = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    wrong += compare(n, n, seed, true, limits).verdict == Verdict::different;
    right += compare(n, n, seed, false, limits).verdict == Verdict::different;
  }
  EXPECT_GT(wrong, 50);  // what trusting them would do
  EXPECT_LE(right, 11);  // 5 and three deviations
}

TEST(ZTest, RunsTellWhatDependentPixelsDoNot) {
  // 24 runs of dependent pixels against a quiet picture of independent ones: equal at the nominal
  // rate, and one percent more is seen, which the bound for a single run cannot.
  Noisy n, quiet, brighter;
  for (Noisy* p : {&n, &quiet, &brighter}) p->width = p->height = 32;
  n.shared = brighter.shared = 0.8;
  n.samples = brighter.samples = 16384;
  brighter.level = 1.01;
  quiet.samples = 1e6;
  ZTestLimits limits;
  limits.alpha = 0.05;
  int different = 0, seen = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const Image reference = make(quiet, 9000 + seed);
    std::vector<Image> same, off;
    for (unsigned k = 0; k < 24; ++k) {
      same.push_back(make(n, 24 * seed + k));
      off.push_back(make(brighter, 24 * seed + k));
    }
    NoisyImage a{{}, n.samples, false}, b{{}, n.samples, false};
    for (unsigned k = 0; k < 24; ++k) {
      a.runs.push_back(&same[k]);
      b.runs.push_back(&off[k]);
    }
    const NoisyImage r{{&reference}, quiet.samples, true};
    different += z_test(a, r, limits).verdict == Verdict::different;
    seen += z_test(b, r).verdict == Verdict::different;
  }
  EXPECT_LE(different, 8);  // 3 and three deviations
  EXPECT_EQ(seen, 60);
}

TEST(ZTest, RunsOfIndependentPixelsAreOneLongerRun) {
  Noisy n;
  n.samples = 256;
  const Image a = make(n, 1), b = make(n, 2), c = make(n, 3), d = make(n, 4), r = make(n, 5);
  const NoisyImage reference{{&r}, 1e9, true};  // as if it were quiet
  const double one = z_test({{&a}, 256, true}, reference).detectable_image;
  const ZTest four = z_test({{&a, &b, &c, &d}, 256, true}, reference);
  // Variances: v + v against v/4 + v.
  EXPECT_NEAR(four.detectable_image / one, std::sqrt(1.25 / 2), 0.02);
}

TEST(ZTest, PicturesWithoutNoiseAreExact) {
  Noisy n;
  n.cv = 0;
  const Image a = make(n, 1);
  Image rounded = a, other = a;
  for (std::size_t i = 0; i < a.data.size(); i += 6) {
    rounded.data[i] = std::nextafter(1.0f, 2.0f);
    other.data[i] = 1.0001f;
  }
  EXPECT_TRUE(z_test({{&a}, 64, true}, {{&a}, 64, true}).identical);
  const ZTest close = z_test({{&rounded}, 64, true}, {{&a}, 64, true});
  EXPECT_EQ(close.verdict, Verdict::equal) << close.reason;
  EXPECT_FALSE(close.identical);
  EXPECT_EQ(z_test({{&other}, 64, true}, {{&a}, 64, true}).verdict, Verdict::different);
}

TEST(ZTest, RareEventsAreNotJudged) {
  // Nearly all light of a picture in a few samples: 32 of 12288 carry it.
  Noisy n;
  n.cv = 0;
  n.level = 0;
  n.samples = 1;
  Image a = make(n, 1), b = a;
  for (Image* image : {&a, &b})
    for (std::size_t i = 0; i < 32; ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        image->data[(i * 90 + (image == &b ? 7 : 0)) * 6 + c] = 1;
        image->data[(i * 90 + (image == &b ? 7 : 0)) * 6 + 3 + c] = 1;
      }
  const ZTest test = z_test({{&a}, 1, true}, {{&b}, 1, true}, {1e-4, 0.95, 10, 10, 300});
  EXPECT_EQ(test.verdict, Verdict::inconclusive);
  EXPECT_LT(test.image_events, 40);
  EXPECT_NE(test.reason.find("samples matter"), std::string::npos);
}

TEST(ZTest, MapIsTheDifferenceInDeviations) {
  Noisy n;
  Image a = make(n, 1), b = make(n, 2);
  for (std::size_t i = 0; i < a.data.size(); i += 6)
    for (std::size_t c = 0; c < 3; ++c) {
      a.data[i + c] = 2;
      b.data[i + c] = 1;
      a.data[i + 3 + c] = 0.09f;
      b.data[i + 3 + c] = 0.16f;
    }
  for (const float v : z_map(a, b).data) EXPECT_NEAR(v, 2, 1e-5);
}

}  // namespace
}  // namespace pellucid

// The split of error into variance and bias: by hand, and on runs whose noise and bias are known.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "image/replicates.h"

namespace pellucid {
namespace {

Image grey(std::vector<float> data) {
  Image image;
  image.width = int(data.size());
  image.height = 1;
  image.channels = {"Y"};
  image.data = std::move(data);
  return image;
}

RunSplit split_error_of(const std::vector<Image>& runs, const Image& reference) {
  std::vector<const Image*> pointers;
  for (const Image& run : runs) pointers.push_back(&run);
  return split_error(pointers, reference);
}

TEST(Replicates, HandComputed) {
  // Pixel 0: runs 1, 3, reference 1: s^2 = 2, mean 2, (2-1)^2 - 2/2 = 0. Pixel 1: runs 5, 5,
  // reference 2: s^2 = 0, bias^2 = 9.
  const RunSplit split = split_error_of({grey({1, 5}), grey({3, 5})}, grey({1, 2}));
  EXPECT_DOUBLE_EQ(split.absolute.variance, 1.0);
  EXPECT_DOUBLE_EQ(split.absolute.bias2, 4.5);
  EXPECT_DOUBLE_EQ(split.absolute.mse(), 5.5);
  EXPECT_FALSE(split.reference_variance);
  const double e2 = 0.015 * 0.015;
  EXPECT_NEAR(split.relative.variance, 0.5 * 2 / (1 + e2), 1e-12);
  EXPECT_NEAR(split.relative.bias2, 0.5 * 9 / (4 + e2), 1e-12);
}

TEST(Replicates, ReferencesOwnVarianceIsNoBias) {
  Image reference;
  reference.width = reference.height = 1;
  reference.channels = {"R", "G", "B", "variance.R", "variance.G", "variance.B"};
  reference.data = {1, 1, 1, 0.25f, 0.5f, 0.75f};
  Image run;
  run.width = run.height = 1;
  run.channels = {"R", "G", "B"};
  run.data = {3, 3, 3};
  const RunSplit split = split_error_of({run, run}, reference);
  EXPECT_TRUE(split.reference_variance);
  EXPECT_DOUBLE_EQ(split.absolute.bias2, 4 - 0.5);
  EXPECT_NEAR(split.reference_share, 0.5 / 3.5, 1e-12);  // on one scale: all pixels are equal
  reference.data[3] = std::numeric_limits<float>::quiet_NaN();  // too few passes to tell
  EXPECT_FALSE(split_error_of({run, run}, reference).reference_variance);
}

TEST(Replicates, NotFiniteIsCounted) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const RunSplit split = split_error_of({grey({1, nan}), grey({1, 2})}, grey({1, 2}));
  EXPECT_EQ(split.nonfinite, 1u);
  EXPECT_TRUE(std::isnan(split.absolute.variance));
  EXPECT_TRUE(std::isnan(split.relative.bias2_upper90));
}

struct Coverage {
  double bound = 0, variance = 0;  ///< shares of sets whose intervals hold the truth
  double mean_bias2 = 0, mean_variance = 0, mean_bound = 0;
};

/// Sets of runs of 300 grey pixels of 1, all off by `bias`, with noise of deviation 1 in each pixel
/// and `common` in all pixels of a run at once.
Coverage cover(int runs, double bias, double common, int sets) {
  Coverage c;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  for (int s = 0; s < sets; ++s) {
    std::vector<Image> images;
    for (int k = 0; k < runs; ++k) {
      const double shift = 1 + bias + common * normal(random);
      std::vector<float> pixels(300);
      for (float& v : pixels) v = float(shift + normal(random));
      images.push_back(grey(pixels));
    }
    const ErrorSplit e = split_error_of(images, grey(std::vector<float>(300, 1.0f))).absolute;
    const double variance = 1 + common * common;
    c.bound += (e.bias2_upper90 >= bias * bias) / double(sets);
    c.variance += (e.variance_low90 <= variance && variance <= e.variance_high90) / double(sets);
    c.mean_bias2 += e.bias2 / sets;
    c.mean_variance += e.variance / sets;
    c.mean_bound += e.bias2_upper90 / sets;
  }
  return c;
}

TEST(Replicates, EstimatesAreUnbiasedAndTheBoundHolds) {
  // Mean of 200 sets: bias^2 deviates by about 2 bias sqrt(v/300K) + v sqrt(2/300) / K in one,
  // where v = 1, plus 2 bias common / sqrt(K) + common^2 sqrt(2) / K from what pixels share; five
  // of these over sqrt(200) are allowed.
  for (const int runs : {2, 4, 10})
    for (const double bias : {0.0, 0.1, 0.3})
      for (const double common : {0.0, 0.3}) {
        const Coverage c = cover(runs, bias, common, 200);
        const double k = runs, sd = 2 * bias / std::sqrt(300 * k) + std::sqrt(2 / 300.0) / k +
                                    2 * bias * common / std::sqrt(k) +
                                    common * common * std::sqrt(2.0) / k;
        const std::string what = std::to_string(runs) + " runs, bias " + std::to_string(bias) +
                                 ", common " + std::to_string(common);
        EXPECT_NEAR(c.mean_bias2, bias * bias, 5 * sd / std::sqrt(200.0)) << what;
        EXPECT_NEAR(c.mean_variance, 1 + common * common, 0.06) << what;
        // 90 % nominal; three deviations of 200 draws below it.
        EXPECT_GE(c.bound, 0.9 - 3 * std::sqrt(0.09 / 200)) << what;
        // Useful, too: within what is left of one run's noise in the mean of all.
        EXPECT_LE(c.mean_bound, bias * bias + 4 * (1 + common * common) / k) << what;
      }
}

TEST(Replicates, SameRunsGiveTheSameIntervals) {
  const std::vector<Image> runs{grey({1, 2, 3}), grey({2, 2, 4}), grey({1, 3, 3})};
  const ErrorSplit a = split_error_of(runs, grey({1, 2, 3})).absolute;
  const ErrorSplit b = split_error_of(runs, grey({1, 2, 3})).absolute;
  EXPECT_EQ(a.bias2_upper90, b.bias2_upper90);
  EXPECT_EQ(a.variance_low90, b.variance_low90);
  EXPECT_LE(a.variance_low90, a.variance);
  EXPECT_GE(a.variance_high90, a.variance);
}

}  // namespace
}  // namespace pellucid

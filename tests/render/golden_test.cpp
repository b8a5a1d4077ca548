// Goldens: `path` against pictures that another method made once (tests/golden/goldens.txt).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "image/image.h"
#include "render_harness.h"
#include "support/statistics.h"

namespace pellucid::test {
namespace {

struct Golden {
  std::string scene, method, size, spp;
  friend void PrintTo(const Golden& g, std::ostream* out) { *out << g.scene; }
};

std::string folder() {
  return std::string(PELLUCID_SOURCE_DIR) + "/tests/golden/";
}

std::vector<Golden> goldens() {
  std::vector<Golden> all;
  std::ifstream file(folder() + "goldens.txt");
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    Golden g;
    if (words >> g.scene >> g.method >> g.size >> g.spp) all.push_back(g);
  }
  return all;
}

/// Mean and variance of a block of pixels in an image with variance channels.
Estimate block(const Image& image, int channel, int x0, int y0, int width, int height) {
  const std::size_t channels = image.channels.size();
  const auto mean = std::size_t(image.channel(std::string(1, "RGB"[channel])));
  const auto variance = std::size_t(image.channel(std::string("variance.") + "RGB"[channel]));
  Estimate e;
  const double n = double(width) * height;
  for (int y = y0; y < y0 + height; ++y)
    for (int x = x0; x < x0 + width; ++x) {
      const float* pixel =
          &image.data[(std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * channels];
      e.mean += double(pixel[mean]) / n;
      e.variance += double(pixel[variance]) / (n * n);
    }
  return e;
}

double sigmas(const Estimate& a, const Estimate& b) {
  const double variance = a.variance + b.variance;
  return variance > 0       ? std::abs(a.mean - b.mean) / std::sqrt(variance)
         : a.mean == b.mean ? 0
                            : 1e9;
}

/// z of a two-sided normal test at `level`.
double critical(double level) {
  double low = 0, high = 40;
  for (int i = 0; i < 60; ++i) {
    const double mid = 0.5 * (low + high);
    (std::erfc(mid / std::sqrt(2.0)) > level ? low : high) = mid;
  }
  return high;
}

/// Whole image: within tolerance, and known well enough to say so.
void expect_same_energy(const Image& ours, const Image& golden) {
  for (int c = 0; c < 3; ++c) {
    const Estimate a = block(ours, c, 0, 0, ours.width, ours.height);
    const Estimate b = block(golden, c, 0, 0, ours.width, ours.height);
    const Estimate difference{a.mean - b.mean + 1, a.variance + b.variance};
    const double off = std::abs(a.mean - b.mean), width = 4.5 * difference.error();
    EXPECT_LE(off, width) << fmt::format("channel {}: {:.6g} against {:.6g}", c, a.mean, b.mean);
    EXPECT_LE(off + width, tier_tolerance() * b.mean)
        << fmt::format("INCONCLUSIVE, channel {}: off by {:.2g}, 4.5 sigma {:.2g}", c, off, width);
  }
}

/// Blocks of 4x4 pixels, corrected for their number; pixels by their share within 4 sigma, since
/// the variance of a single one misses rare bright paths. 2 % of them forgives caustics, and 16
/// times as many samples stand behind a block.
void expect_same_places(const Image& ours, const Image& golden) {
  constexpr int side = 4;
  const int blocks = 3 * (ours.width / side) * (ours.height / side);
  const double limit = critical(sidak(family_alpha, blocks));
  int outside = 0;
  for (int c = 0; c < 3; ++c) {
    for (int y = 0; y + side <= ours.height; y += side)
      for (int x = 0; x + side <= ours.width; x += side) {
        const Estimate a = block(ours, c, x, y, side, side), b = block(golden, c, x, y, side, side);
        EXPECT_LE(sigmas(a, b), limit) << fmt::format(
            "block at {},{} channel {}: {:.5g} against {:.5g}", x, y, c, a.mean, b.mean);
      }
    for (int y = 0; y < ours.height; ++y)
      for (int x = 0; x < ours.width; ++x)
        outside += sigmas(block(ours, c, x, y, 1, 1), block(golden, c, x, y, 1, 1)) > 4;
  }
  EXPECT_LE(outside, 0.02 * 3 * ours.width * ours.height);
}

class GoldenTest : public testing::TestWithParam<Golden> {};

TEST_P(GoldenTest, agrees_with_path) {
  const Golden& g = GetParam();
  ASSERT_NE(g.method, "path") << "a golden is not made by the method that it judges";
  Image golden;
  ASSERT_NO_THROW(golden = read_image(folder() + g.scene + ".exr"))
      << "a missing golden is a failure";
  EXPECT_EQ(std::get<std::string>(golden.metadata.at("pellucid:integrator")), g.method);
  EXPECT_EQ(fmt::format("{}x{}", golden.width, golden.height), g.size);
  const Scene scene = scene_named(g.scene);
  Renderer renderer(scene, {"path", golden.width, golden.height});
  Sampling sampling;
  if (scene.settings.max_depth) sampling.max_depth = uint(*scene.settings.max_depth);
  const auto most = std::uint64_t(32768 * tier_effort());
  sampling.spp =
      std::max<std::uint64_t>(512, renderer.spp_for(sampling, tier_tolerance() / 9, most));
  const Picture picture = renderer.render(sampling);
  const Image ours = film_image(picture.film, true, false);
  expect_same_energy(ours, golden);
  expect_same_places(ours, golden);
}

INSTANTIATE_TEST_SUITE_P(Goldens, GoldenTest, testing::ValuesIn(goldens()), [](const auto& test) {
  std::string name = test.param.scene;
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
});

// An empty list would let everything pass.
TEST(GoldenList, is_complete) {
  EXPECT_GE(goldens().size(), 4u);
}

}  // namespace
}  // namespace pellucid::test

// Heat maps: scales that fit their numbers, colours that mean what the scale says, any size.
#include "image/heat_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "image/tonemap.h"

namespace pellucid {
namespace {

std::vector<float> flat(int width, int height, float value) {
  return std::vector<float>(std::size_t(width * height), value);
}

int count_of(const Image& image, const std::array<float, 3>& colour) {
  int n = 0;
  for (std::size_t i = 0; i < image.data.size(); i += 3)
    n += std::equal(colour.begin(), colour.end(), image.data.begin() + std::ptrdiff_t(i));
  return n;
}

TEST(HeatMap, scales_end_at_round_numbers) {
  const auto ends = [](const std::vector<float>& values) {
    const HeatScale s = heat_scale(values);
    return std::pair{s.low, s.high};
  };
  EXPECT_EQ(ends({1.5f}), std::pair(1.0, 2.0));
  EXPECT_EQ(ends({3, 40}), std::pair(2.0, 50.0));
  EXPECT_EQ(ends({0.7f, 0, 0}), std::pair(0.5, 1.0)) << "0 is off the scale";
  EXPECT_EQ(ends({1, 10}), std::pair(1.0, 20.0)) << "no value is at the upper end";
  EXPECT_EQ(ends({}), std::pair(1.0, 10.0));
  EXPECT_DOUBLE_EQ(ends({0.003f, 3e7f}).first, 0.002);
  EXPECT_DOUBLE_EQ(ends({0.003f, 3e7f}).second, 5e7);
  std::vector<float> some(1000, 3.0f);
  for (std::size_t i = 0; i < 5; ++i) some[i] = 1e-9f, some[i + 5] = 1e9f;
  EXPECT_EQ(ends(some), std::pair(2.0, 5.0)) << "a few do not stretch it";
  EXPECT_EQ((HeatScale{0.5, 20}.ticks()), (std::vector<double>{0.5, 1, 2, 5, 10, 20}));
  EXPECT_EQ((HeatScale{0.005, 0.02}.ticks().size()), 3u);
}

TEST(HeatMap, places_are_logarithms) {
  const HeatScale scale{1, 100};
  EXPECT_EQ(scale.place(0), 0.0f);
  EXPECT_EQ(scale.place(0.5f), 0.0f);
  EXPECT_FLOAT_EQ(scale.place(10), 0.5f);
  EXPECT_EQ(scale.place(100), 1.0f);
  EXPECT_EQ(scale.place(1e9f), 1.0f);
  EXPECT_EQ(scale.colour(0), (std::array<float, 3>{0, 0, 0}));
  EXPECT_EQ(scale.colour(1), scale.colour(0.5f));
  EXPECT_NE(scale.colour(1), scale.colour(0)) << "little is not nothing";
  EXPECT_EQ(scale.colour(100), (std::array<float, 3>{1, 1, 1}));
}

TEST(HeatMap, pixels_have_the_colours_of_their_values) {
  constexpr int w = 200, h = 180;
  std::vector<float> halves = flat(w, h, 1.5f);
  std::fill_n(halves.begin(), w * h / 2, 0.0f);
  const std::array<float, 3> colour = heat_scale(halves).colour(1.5f);
  const std::vector<HeatMap> one{{"photons", halves, {}}};
  EXPECT_EQ(count_of(draw_heat_maps(w, h, one), colour), w * h / 2);
  EXPECT_GE(count_of(draw_heat_maps(w, h, one), {0, 0, 0}), w * h / 2);
  // Parity tells neighbours apart, whatever the value; 0 leaves the background.
  for (const float value : {0.0f, 1.5f}) {
    std::vector<float> parity = flat(w, h, 1);
    std::fill_n(parity.begin(), w, 2.0f);
    std::fill_n(parity.begin() + w, 3 * w, 0.0f);
    const Image image = draw_heat_maps(w, h, {{"", flat(w, h, value), parity}});
    std::array<float, 3> dark = heat_scale(flat(w, h, value)).colour(value);
    for (float& c : dark) c *= 0.85f;
    EXPECT_GE(count_of(image, dark), w * (h - 4));
    for (float& c : dark) c += 0.15f;
    EXPECT_GE(count_of(image, dark), w);
  }
}

TEST(HeatMap, any_size) {
  for (const auto& [w, h] : {std::pair{1, 1}, {1, 700}, {700, 1}, {7, 5}, {257, 256}}) {
    const HeatMap map{"radius in pixels", flat(w, h, 1e-12f), flat(w, h, 1)};
    const Image image = draw_heat_maps(w, h, {map, map, map});
    EXPECT_EQ(image.data.size(), std::size_t(image.width) * std::size_t(image.height) * 3);
    EXPECT_LT(std::max(image.width, image.height), 1000) << w << "x" << h;
    EXPECT_GE(image.width, std::max(w, 180)) << w << "x" << h;
  }
}

}  // namespace
}  // namespace pellucid

// The pyramid as a picture: where cells lie, how bright rows are, and pictures of any size.
#include "image/atlas.h"

#include <gtest/gtest.h>

#include <cmath>

#include "image/canvas.h"
#include "image/tonemap.h"

namespace pellucid {
namespace {

std::vector<float> flat(int width, int height, float value) {
  return std::vector<float>(std::size_t(width * height) * 3, value);
}

/// Pixels that have exactly this display value.
int count_of(const Image& image, float value) {
  int n = 0;
  for (std::size_t i = 0; i < image.data.size(); i += 3) n += image.data[i] == value;
  return n;
}

TEST(Atlas, exposure_in_half_stops) {
  EXPECT_EQ(row_exposure(flat(4, 4, 0.0f)), 0.0);
  EXPECT_EQ(row_exposure({}), 0.0);
  for (const double stops : {-20.0, -3.5, 0.0, 0.5, 11.0})
    EXPECT_EQ(row_exposure(flat(4, 4, float(0.7 * std::exp2(-stops)))), stops);
  // Black pixels do not count, nor does the brightest tenth, nor any channel but the brightest.
  std::vector<float> picture = flat(30, 1, 0.0f);
  for (std::size_t i = 0; i < 11; ++i) picture[3 * i + 1] = i ? 0.35f : 1e6f;
  EXPECT_EQ(row_exposure(picture), 1.0);
}

TEST(Atlas, a_row_has_one_exposure_and_cells_lie_side_by_side) {
  constexpr int w = 80, h = 60;
  // Weighted cells add up to 0.35, so 1 stop; row 1 is 4 stops brighter.
  const std::vector<AtlasCell> cells{{true, 0, 0, "s=0 t=2", flat(w, h, 0.25f)},
                                     {true, 0, 1, "s=1 t=1", flat(w, h, 0.1f)},
                                     {false, 0, 0, "s=0 t=2", flat(w, h, 0.3f)},
                                     {true, 1, 2, "s=2 t=1", flat(w, h, 5.6f)},
                                     {false, 1, 1, "s=1 t=2", flat(w, h, 0.0f)}};
  const Image image = draw_atlas(w, h, {"length 1", "length 2"}, cells);
  for (const float shown : {0.5f, 0.2f, 0.6f})
    EXPECT_EQ(count_of(image, srgb_encode(shown)), w * h) << shown;
  EXPECT_EQ(count_of(image, srgb_encode(0.7f)), w * h) << "-3 stops";
  EXPECT_EQ(count_of(image, 0.0f), w * h) << "black, which is not the background";
  // The column of a cell is its place: that of s=1 begins one cell to the right of s=0.
  const auto left_of = [&](float value) {
    for (int x = 0; x < image.width; ++x)
      for (int y = 0; y < image.height; ++y)
        if (image.data[std::size_t(y * image.width + x) * 3] == value) return x;
    return -1;
  };
  const int pitch = left_of(srgb_encode(0.2f)) - left_of(srgb_encode(0.5f));
  EXPECT_GE(pitch, w);
  EXPECT_LT(pitch, w + 10);
  EXPECT_EQ(left_of(srgb_encode(0.7f)) - left_of(srgb_encode(0.5f)), 2 * pitch);
}

TEST(Atlas, a_row_that_is_black_when_weighted_shows_the_rest) {
  const Image image =
      draw_atlas(64, 64, {"length 1"},
                 {{true, 0, 0, "", flat(64, 64, 0.0f)}, {false, 0, 0, "", flat(64, 64, 0.07f)}});
  // 2^3.5 is nearer to 10 than 2^3.
  EXPECT_EQ(count_of(image, srgb_encode(0.07f * std::exp2(3.5f))), 64 * 64);
}

TEST(Atlas, large_pictures_are_averaged) {
  constexpr int w = 1000, h = 10;  // by 4: 250 x 3, the last row of 2 pixels
  std::vector<float> picture = flat(w, h, 0.0f);
  for (int y = 0; y < h; ++y)
    for (int x = y % 2; x < w; x += 2)
      for (int c = 0; c < 3; ++c) picture[std::size_t(3 * (y * w + x) + c)] = 1.4f;
  const Image image = draw_atlas(w, h, {"length 1"}, {{true, 0, 0, "s=0 t=2", picture}});
  EXPECT_EQ(count_of(image, srgb_encode(0.35f)), 250 * 3) << "half of 1.4 at -1 stop";
}

TEST(Atlas, any_size) {
  for (const auto& [w, h] : {std::pair{1, 1}, {1, 3000}, {3000, 1}, {7, 5}, {257, 256}}) {
    const std::vector<AtlasCell> cells{{true, 0, 0, "s=30 t=30", flat(w, h, 0.7f)},
                                       {false, 1, 0, "all", flat(w, h, 0.7f)}};
    const Image image = draw_atlas(w, h, {"length 1", "longer"}, cells);
    EXPECT_EQ(image.data.size(), std::size_t(image.width) * std::size_t(image.height) * 3);
    EXPECT_LT(image.width, 700) << w << "x" << h;
    EXPECT_LT(image.height, 700) << w << "x" << h;
    EXPECT_GT(count_of(image, srgb_encode(0.7f)), 0);
  }
}

TEST(Atlas, letters) {
  for (const char* text :
       {"0123456789", "+- .=", "length", "longer", "all", "weighted", "unweighted", "s=0 t=2",
        "+12.5 EV", "merged", "k=2", "photons in the cell, pass 0", "radius in pixels", "5e-06"})
    EXPECT_TRUE(can_draw(text)) << text;
  EXPECT_FALSE(can_draw("?"));
}

}  // namespace
}  // namespace pellucid

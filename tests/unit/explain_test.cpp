// Why two pictures differ, on made-up rooms in which the reason is known.
#include "explain/explain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "base/error.h"

namespace pellucid::explain {
namespace {

constexpr int SIZE = 64;
constexpr std::size_t PIXELS = SIZE * SIZE, LENGTHS = 12;  // and one layer for all that is longer

/// Radiance by layer, pixel and channel.
using Room = std::vector<std::vector<std::array<double, 3>>>;

double bump(int x, int y, double cx, double cy, double width) {
  return std::exp(-((x - cx) * (x - cx) + (y - cy) * (y - cy)) / (2 * width * width));
}

/// A lamp at the top that lights what is below it; light that evens out with every bounce.
Room room() {
  Room layers(LENGTHS + 1, std::vector<std::array<double, 3>>(PIXELS));
  const double lamp[3] = {18, 11, 3}, albedo[3] = {0.6, 0.5, 0.4};
  for (int y = 0; y < SIZE; ++y)
    for (int x = 0; x < SIZE; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        const auto p = std::size_t(y * SIZE + x);
        const bool on_lamp = x >= 26 && x < 38 && y >= 6 && y < 11;
        const bool ceiling = y < 16;
        layers[0][p][c] = on_lamp ? lamp[c] : 0;
        for (std::size_t k = 1; k <= LENGTHS; ++k) {
          // Each length has a pattern of its own, by a share that falls.
          const double own = bump(x, y, 10 + 9.0 * double(k * 7 % 6), 60 - 8.0 * double(k % 7), 14);
          const double even = 0.5 + 0.3 * std::cos(0.05 * (x + 2 * y));
          const double mixed = std::pow(0.7, double(k - 1));
          double value = 0.06 * lamp[c] * std::pow(albedo[c], double(k)) * (mixed * own + even);
          if (k == LENGTHS) value *= albedo[c] / (1 - albedo[c]) / albedo[c];
          if (k == 1 && ceiling) value = 0;  // the lamp shines downwards
          layers[k][p][c] = value;
        }
      }
  return layers;
}

/// Noise of one pixel and layer: of a mean of 1.
using NoiseOf = std::function<double(std::mt19937_64&, std::size_t layer)>;

/// As a renderer would store it.
Image picture(const Room& layers, const NoiseOf& noise_of, unsigned seed, bool with_layers = true) {
  Image image;
  image.width = image.height = SIZE;
  image.channels = {"R", "G", "B"};
  for (std::size_t k = 0; k < layers.size() && with_layers; ++k)
    for (const char* c : {"R", "G", "B"})
      image.channels.push_back("length." +
                               (k < layers.size() - 1 ? std::to_string(k + 1) : "rest") + "." + c);
  std::mt19937_64 random(seed);
  for (std::size_t p = 0; p < PIXELS; ++p) {
    const std::size_t first = image.data.size();
    image.data.resize(first + image.channels.size());
    std::array<double, 3> sum{};
    for (std::size_t k = 0; k < layers.size(); ++k) {
      const double noise = noise_of(random, k);
      for (std::size_t c = 0; c < 3; ++c) {
        const double value = layers[k][p][c] * noise;
        sum[c] += value;
        if (with_layers) image.data[first + 3 * (k + 1) + c] = float(value);
      }
    }
    for (std::size_t c = 0; c < 3; ++c) image.data[first + c] = float(sum[c]);
  }
  return image;
}

/// Every layer with noise of its own, `cv` of each pixel; but lamps show themselves without.
Image picture(const Room& layers, double cv, unsigned seed, bool with_layers = true) {
  std::normal_distribution<double> normal;
  const NoiseOf even = [&](std::mt19937_64& random, std::size_t layer) {
    return 1 + (layer ? cv * normal(random) : 0);
  };
  return picture(layers, even, seed, with_layers);
}

Explanation explain_images(const Image& a, const Image& b) {
  const Layered known(a), other(b);
  return explain(known, other, {"A", "B"}, other.layers() > 0);
}

double figure(const Explanation& x, const std::string& name) {
  for (const auto& [key, value] : x.causes.front().cause.figures)
    if (key == name) return value;
  ADD_FAILURE() << "no figure " << name << " of " << x.causes.front().cause.id;
  return std::nan("");
}

using Change = std::function<void(std::size_t layer, int x, int y, std::array<double, 3>& value)>;

Room changed(const Change& change) {
  Room layers = room();
  for (std::size_t k = 0; k < layers.size(); ++k)
    for (int y = 0; y < SIZE; ++y)
      for (int x = 0; x < SIZE; ++x) change(k, x, y, layers[k][std::size_t(y * SIZE + x)]);
  return layers;
}

/// That the cause is named with and without layers; `check` gets both explanations.
void expect_cause(const Room& other, const std::string& cause,
                  const std::function<void(const Explanation&)>& check = {}, double cv = 0.05) {
  const Image a = picture(room(), cv, 1);
  for (const bool with_layers : {true, false}) {
    const Explanation x = explain_images(a, picture(other, cv, 2, with_layers));
    SCOPED_TRACE(x.words);
    EXPECT_TRUE(x.finding == Finding::cause || x.finding == Finding::several)
        << finding_name(x.finding);
    ASSERT_FALSE(x.causes.empty());
    EXPECT_EQ(x.causes.front().cause.id, cause) << (with_layers ? "layers" : "regression");
    EXPECT_EQ(x.by_regression, !with_layers);
    if (check && x.causes.front().cause.id == cause) check(x);
  }
}

TEST(Explain, equal_pictures_have_no_difference) {
  const Room same = room();
  constexpr double cv = 0.1;
  double energy = 0, deviation = 0;  // of the sums over pixels of the difference
  for (std::size_t c = 0; c < 3; ++c) {
    double variance = 0;
    for (std::size_t k = 0; k < same.size(); ++k)
      for (const auto& v : same[k]) {
        energy += v[c];
        variance += k ? 2 * cv * cv * v[c] * v[c] : 0;
      }
    deviation += std::sqrt(variance);
  }
  for (unsigned seed = 0; seed < 30; ++seed) {
    const Image a = picture(same, cv, 2 * seed);
    const Explanation x = explain_images(a, picture(same, cv, 2 * seed + 1, seed % 2 == 0));
    EXPECT_EQ(x.finding, Finding::none) << "seed " << seed << ": " << x.words;
    // 4.5 deviations; what is sharp within cells may count as noise, but not double it.
    EXPECT_GT(x.detectable, 0.9 * 4.5 * deviation / energy);
    EXPECT_LT(x.detectable, 2 * 4.5 * deviation / energy);
  }
}

TEST(Explain, rare_bright_paths_are_no_difference) {
  // Half of the light of long paths comes in one pixel of 300.
  const NoiseOf rare = [](std::mt19937_64& random, std::size_t layer) {
    std::normal_distribution<double> normal(1, 0.1);
    if (layer < 4) return layer ? normal(random) : 1;
    return 0.5 * normal(random) + (random() % 300 == 0 ? 0.5 * 300 : 0);
  };
  const Room same = room();
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Image a = picture(same, rare, 2 * seed);
    const Explanation x = explain_images(a, picture(same, rare, 2 * seed + 1, seed % 2 == 0));
    EXPECT_EQ(x.finding, Finding::none) << "seed " << seed << ": " << x.words;
  }
}

TEST(Explain, exposure) {
  const Change brighter = [](std::size_t, int, int, std::array<double, 3>& v) {
    for (double& value : v) value *= 1.05;
  };
  expect_cause(changed(brighter), "exposure",
               [](const Explanation& x) { EXPECT_NEAR(figure(x, "factor"), 1.05, 0.002); });
  const Change warmer = [](std::size_t, int, int, std::array<double, 3>& v) {
    v[0] *= 1.1, v[2] *= 0.9;
  };
  expect_cause(changed(warmer), "exposure", [](const Explanation& x) {
    EXPECT_NEAR(figure(x, "factor_r"), 1.1, 0.005);
    EXPECT_NEAR(figure(x, "factor_b"), 0.9, 0.005);
  });
}

TEST(Explain, lights_that_show_less_than_they_light) {
  const Change hidden = [](std::size_t layer, int, int, std::array<double, 3>& v) {
    if (layer == 0) v = {};
  };
  expect_cause(changed(hidden), "visible-lights",
               [](const Explanation& x) { EXPECT_NEAR(figure(x, "factor"), 0, 0.01); });
  const Change lit = [](std::size_t layer, int, int, std::array<double, 3>& v) {
    for (double& value : v) value *= layer ? 1.1 : 1;
  };
  expect_cause(changed(lit), "illumination",
               [](const Explanation& x) { EXPECT_NEAR(figure(x, "factor"), 1.1, 0.005); });
}

TEST(Explain, albedo) {
  const Change more = [](std::size_t layer, int, int, std::array<double, 3>& v) {
    for (double& value : v) value *= std::pow(1.02, double(layer));
  };
  expect_cause(changed(more), "albedo",
               [](const Explanation& x) { EXPECT_NEAR(figure(x, "per_bounce"), 1.02, 0.002); });
  const Change redder = [](std::size_t layer, int, int, std::array<double, 3>& v) {
    v[0] *= std::pow(1.05, double(layer)), v[2] *= std::pow(0.9, double(layer));
  };
  expect_cause(changed(redder), "albedo", [](const Explanation& x) {
    EXPECT_NEAR(figure(x, "per_bounce_r"), 1.05, 0.005);
    EXPECT_NEAR(figure(x, "per_bounce_b"), 0.9, 0.01);
    EXPECT_NE(x.words.find("colour space"), std::string::npos);
  });
}

TEST(Explain, depth_cap_and_roulette) {
  const Change cut = [](std::size_t layer, int, int, std::array<double, 3>& v) {
    if (layer >= 5) v = {};
  };
  expect_cause(
      changed(cut), "depth-cap", [](const Explanation& x) { EXPECT_EQ(figure(x, "max_depth"), 5); },
      0.02);
  const Explanation of_a = explain_images(picture(changed(cut), 0.02, 1), picture(room(), 0.02, 2));
  EXPECT_EQ(of_a.finding, Finding::cause) << of_a.words;
  EXPECT_NE(of_a.words.find("A has no light from paths of more than 5 segments"), std::string::npos)
      << of_a.words;
  const Change half = [](std::size_t layer, int, int, std::array<double, 3>& v) {
    for (double& value : v) value *= layer >= 4 ? 0.5 : 1;
  };
  expect_cause(
      changed(half), "late-paths",
      [](const Explanation& x) {
        EXPECT_EQ(figure(x, "longest_equal"), 4);
        EXPECT_NEAR(figure(x, "factor"), 0.5, 0.05);
      },
      0.02);
}

TEST(Explain, clamp) {
  const Change cut = [](std::size_t layer, int, int, std::array<double, 3>& v) {
    for (double& value : v) value = layer ? value : std::min(value, 10.0);
  };
  expect_cause(changed(cut), "clamp",
               [](const Explanation& x) { EXPECT_NEAR(figure(x, "clamp"), 10, 0.3); });
}

TEST(Explain, colour_space) {
  // Rec.709 to Rec.2020.
  const double m[3][3] = {
      {0.6274, 0.3293, 0.0433}, {0.0691, 0.9195, 0.0114}, {0.0164, 0.0880, 0.8956}};
  const Change mixed = [&](std::size_t, int, int, std::array<double, 3>& v) {
    const std::array<double, 3> in = v;
    for (std::size_t c = 0; c < 3; ++c) v[c] = m[c][0] * in[0] + m[c][1] * in[1] + m[c][2] * in[2];
  };
  expect_cause(changed(mixed), "colour-space", [](const Explanation& x) {
    EXPECT_NEAR(figure(x, "g_from_g"), 0.9195, 0.1);
    EXPECT_NEAR(figure(x, "r_from_g"), 0.3293, 0.1);
  });
}

/// Light on the ceiling round the lamp, and what comes of it.
Room two_sided() {
  return changed([](std::size_t layer, int x, int y, std::array<double, 3>& v) {
    if (layer == 1 && y < 16)
      for (double& value : v) value += 1.5 * bump(x, y, 32, 8, 10);
    if (layer >= 2)
      for (double& value : v) value *= 1.4;
  });
}

TEST(Explain, sidedness) {
  expect_cause(two_sided(), "sidedness", [](const Explanation& x) {
    EXPECT_GT(figure(x, "indirect_factor"), 1.2);
    EXPECT_LT(figure(x, "distance_to_lights"), 0.6);
    EXPECT_NE(x.words.find("B has light straight from a lamp"), std::string::npos);
  });
  // The other way round it is A that has two sides.
  const Explanation x = explain_images(picture(two_sided(), 0.05, 1), picture(room(), 0.05, 2));
  EXPECT_EQ(x.causes.front().cause.id, "sidedness") << x.words;
  EXPECT_NE(x.words.find("A has light straight from a lamp"), std::string::npos) << x.words;
}

TEST(Explain, one_place) {
  const Change painted = [](std::size_t layer, int x, int y, std::array<double, 3>& v) {
    for (double& value : v) value *= layer && x >= 44 && x < 60 && y >= 40 && y < 52 ? 0.7 : 1;
  };
  expect_cause(changed(painted), "local", [](const Explanation& x) {
    EXPECT_NE(x.words.find("x 44 to 59, y 40 to 51"), std::string::npos);
  });
}

TEST(Explain, filter) {
  Room blurred = room();
  const Room sharp = room();
  for (std::size_t k = 0; k < sharp.size(); ++k)
    for (int y = 1; y < SIZE - 1; ++y)
      for (int x = 1; x < SIZE - 1; ++x)
        for (std::size_t c = 0; c < 3; ++c) {
          const auto p = std::size_t(y * SIZE + x);
          blurred[k][p][c] =
              0.6 * sharp[k][p][c] + 0.1 * (sharp[k][p - 1][c] + sharp[k][p + 1][c] +
                                            sharp[k][p - SIZE][c] + sharp[k][p + SIZE][c]);
        }
  expect_cause(blurred, "filter", [](const Explanation& x) {
    EXPECT_GT(figure(x, "variance_pixels2"), 0.1);  // 0.2 but for the edge's own softness
    EXPECT_NE(x.words.find("softer"), std::string::npos);
  });
}

TEST(Explain, what_no_cause_makes_is_unexplained) {
  const Room straight = room();
  Room mirrored = straight;
  for (std::size_t k = 0; k < straight.size(); ++k)
    for (int y = 0; y < SIZE; ++y)
      for (int x = 0; x < SIZE; ++x)
        mirrored[k][std::size_t(y * SIZE + x)] =
            straight[k][std::size_t((SIZE - 1 - y) * SIZE + x)];
  for (const bool with_layers : {true, false}) {
    const Explanation x =
        explain_images(picture(straight, 0.05, 1), picture(mirrored, 0.05, 2, with_layers));
    EXPECT_EQ(x.finding, Finding::unexplained) << x.words;
  }
}

TEST(Explain, lengths_that_look_alike_are_put_together) {
  Room alike = room();
  for (std::size_t k = 5; k < alike.size(); ++k)
    for (std::size_t p = 0; p < PIXELS; ++p)
      for (std::size_t c = 0; c < 3; ++c)
        alike[k][p][c] = alike[4][p][c] * std::pow(0.5, double(k - 4));
  const Image a = picture(alike, 0.02, 1);
  const Explanation x = explain_images(a, picture(alike, 0.02, 2, false));
  ASSERT_FALSE(x.lengths.empty());
  EXPECT_EQ(x.lengths.back().name.substr(x.lengths.back().name.find(' ')), " and longer");
  EXPECT_LE(x.lengths.size(), 6u);
  double known = 0;
  for (const Row& row : x.lengths) {
    known += row.all_known();
    EXPECT_NEAR(row.ratio[1], 1, 5 * row.error[1]) << row.name;
    EXPECT_LE(row.all_error(), 0.1) << row.name;
  }
  double all = 0;
  for (const auto& layer : alike)
    for (const auto& v : layer) all += (v[0] + v[1] + v[2]) / double(PIXELS);
  EXPECT_NEAR(known, all, 1e-3 * all);
  EXPECT_FALSE(x.notes.empty());
}

TEST(Explain, pictures_with_other_numbers_of_layers) {
  Room few = room();
  for (std::size_t k = 4; k < few.size(); ++k)
    for (std::size_t p = 0; p < PIXELS && k > 4; ++p)
      for (std::size_t c = 0; c < 3; ++c) few[4][p][c] += few[k][p][c];
  few.resize(5);
  const Image a = picture(room(), 0.05, 1), b = picture(few, 0.05, 2);
  for (const auto& pair : {std::make_pair(&a, &b), std::make_pair(&b, &a)}) {
    const Explanation x = explain_images(*pair.first, *pair.second);
    EXPECT_EQ(x.finding, Finding::none) << x.words;
    EXPECT_EQ(x.lengths.size(), 5u);
    EXPECT_EQ(x.lengths.back().name, "5 and longer");
  }
}

TEST(Explain, layers_have_to_be_whole) {
  Image image = picture(room(), 0.05, 1);
  EXPECT_EQ(Layered(image).layers(), LENGTHS + 1);
  EXPECT_TRUE(Layered(image).adds_up());
  for (std::size_t p = 0; p < PIXELS; ++p) image.data[p * image.channels.size()] *= 1.01f;
  EXPECT_FALSE(Layered(image).adds_up());
  image.channels[image.channels.size() - 1] = "other";
  EXPECT_EQ(Layered(image).layers(), 0u);
  image.channels = {"Y"};
  image.data.resize(PIXELS);
  EXPECT_THROW(Layered{image}, InputError);
}

}  // namespace
}  // namespace pellucid::explain

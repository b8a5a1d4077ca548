// Layers on the device: sums that depend neither on order nor on the kind of atomics, and every way
// they can go wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "cl/device.h"
#include "cl/sources.h"
#include "render/layers.h"
#include "render/specialise.h"
#include "shared/buffers.h"
#include "shared/limits.h"

namespace pellucid {
namespace {

constexpr uint side = 4;  // of the tile, which begins at (1, 1)
constexpr uint picture_side = side + 2;
constexpr float scale = 1048576.0f;
constexpr uint longest = 3, most_s = 2;

struct Contribution {
  float r, g, b;
  uint x, y;  // of the whole picture
  float weight;
  uint s, depth;
};

struct Result {
  Layers layers;
  std::vector<uint> diag;

  std::uint64_t sum(uint x, uint y, uint layer, uint channel = 0) const {
    const std::size_t pixel = (y - 1) * side + (x - 1);
    const uint* word =
        &layers.words[pixel * layers.words_per_pixel() + layer * LAYER_WORDS + 2 * channel];
    return std::uint64_t{word[1]} << 32 | word[0];
  }
};

uint all_layers() {
  return layer_set_of(LAYERS_LENGTH | LAYERS_TECH | LAYERS_VERTICES, longest, most_s);
}

struct LayerRun {
  bool int64_atomics = true;
  std::size_t group = 64;
  std::vector<uint> start;  ///< words to begin with

  Result operator()(const std::vector<Contribution>& list) const {
    Device device = Device::open("");
    Specialisation special;
    special.features.set(INTG_LAYERS);
    special.int64_atomics = int64_atomics;
    Kernel kernel = device.build(
        "probe_layers", KernelFiles().expand("passes/probe_layers.cl", prelude_of(special)),
        options_of(special));
    Result out{Layers(all_layers(), scale, side * side), std::vector<uint>(DIAG_COUNT)};
    if (!start.empty()) out.layers.words = start;
    std::vector<F4> values;
    for (const Contribution& c : list) {
      values.push_back({c.r, c.g, c.b, float(c.y * picture_side + c.x)});
      values.push_back({c.weight, float(c.s), float(c.depth), 0});
    }
    const std::size_t bytes = out.layers.words.size() * sizeof(uint);
    const Buffer words = device.create_buffer("layers", bytes, out.layers.words.data());
    const Buffer diag = device.create_buffer("diag", DIAG_COUNT * sizeof(uint));
    const Buffer input = device.create_buffer("values", values.size() * sizeof(F4), values.data());
    const uint n = uint(list.size());
    Launch launch{};
    launch.width = launch.height = picture_side;
    launch.tile_x = launch.tile_y = 1;
    launch.tile_width = launch.tile_height = side;
    launch.splat_scale = launch.layer_scale = scale;
    launch.layer_set = all_layers();
    kernel.set_buffer(0, words), kernel.set_buffer(1, diag), kernel.set_buffer(2, input);
    kernel.set_bytes(3, &n, sizeof n), kernel.set_bytes(4, &launch, sizeof launch);
    device.launch(kernel, n, group, nullptr);
    device.finish();
    device.read(words, out.layers.words.data(), bytes);
    device.read(diag, out.diag.data(), diag.bytes());
    return out;
  }
};

/// Values over many orders of magnitude; half of them on one pixel, where atomics collide.
std::vector<Contribution> random_list(std::size_t n) {
  std::mt19937 engine(7);
  const auto value = [&] { return std::exp2(float(engine() % 2200) / 100 - 12); };
  const auto at = [&](std::size_t i) { return i % 2 ? 2u : 1 + uint(engine() % side); };
  std::vector<Contribution> list(n);
  for (std::size_t i = 0; i < n; ++i) {
    const uint depth = 1 + uint(engine() % 5), s = depth == 1 ? 0 : uint(engine() % (most_s + 1));
    list[i] = {value(), value(), value(), at(i), at(i), float(engine() % 256) / 255, s, depth};
  }
  return list;
}

TEST(LayersTest, SumsDoNotDependOnOrderGroupOrAtomics) {
  std::vector<Contribution> list = random_list(100000);
  const Result first = LayerRun{}(list);
  std::reverse(list.begin(), list.end());
  EXPECT_EQ((LayerRun{true, 1, {}})(list).layers.words, first.layers.words);
  std::shuffle(list.begin(), list.end(), std::mt19937(3));
  EXPECT_EQ((LayerRun{false, 64, {}})(list).layers.words, first.layers.words);
  EXPECT_EQ((LayerRun{false, 8, {}})(list).layers.words, first.layers.words);
  for (uint d : first.diag) EXPECT_EQ(d, 0u);
}

/// The whole numbers that each contribution becomes, added by the host.
TEST(LayersTest, EveryContributionIsInItsLayers) {
  const std::vector<Contribution> list = random_list(20000);
  const Result result = LayerRun{}(list);
  Layers expected(all_layers(), scale, side * side);
  const auto add = [&](const Contribution& c, uint layer, float weight) {
    const std::size_t pixel = (c.y - 1) * side + (c.x - 1);
    const float values[3] = {c.r * weight, c.g * weight, c.b * weight};
    Layers one(all_layers(), scale, side * side);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto steps = std::uint64_t(std::nearbyint(double(values[k] * scale)));
      const std::size_t word = pixel * one.words_per_pixel() + layer * LAYER_WORDS + 2 * k;
      one.words[word] = uint(steps), one.words[word + 1] = uint(steps >> 32);
    }
    expected.merge(one);
  };
  const uint set = all_layers();
  for (const Contribution& c : list) {
    add(c, layer_of_length(set, c.depth), c.weight);
    add(c, layer_of_weighted(set, c.s, c.depth), c.weight);
    if (c.depth <= longest) add(c, layer_of_unweighted(set, c.s, c.depth), 1.0f);
    const std::size_t pixel = (c.y - 1) * side + (c.x - 1);
    ++expected.words[pixel * expected.words_per_pixel() + layer_of_vertices(set) * LAYER_WORDS];
  }
  EXPECT_EQ(result.layers.words, expected.words);
}

TEST(LayersTest, WhatIsOutsideTheTileIsLeftOut) {
  for (const auto& [x, y] : {std::pair{0u, 1u}, {1u, 0u}, {side + 1, 1u}, {1u, side + 1}}) {
    const Result result = LayerRun{}({{1, 1, 1, x, y, 1, 0, 1}});
    for (uint word : result.layers.words) ASSERT_EQ(word, 0u);
    for (uint d : result.diag) EXPECT_EQ(d, 0u) << "film_splat counts it";
  }
}

TEST(LayersTest, WhatCannotBeAddedIsCounted) {
  const float inf = std::numeric_limits<float>::infinity();
  const uint set = all_layers();
  for (bool int64 : {true, false}) {
    // Length, weighted, unweighted: three parts each.
    const Result bad = LayerRun{int64, 64, {}}(
        {{NAN, 1, 1, 1, 1, 1, 0, 1}, {1, inf, 1, 1, 1, 1, 0, 1}, {1, 1, -1, 1, 1, 1, 0, 1}});
    EXPECT_EQ(bad.diag[DIAG_layer_dropped], 9u);
    for (uint layer = 0; layer < layer_of_vertices(set); ++layer)
      EXPECT_EQ(bad.sum(1, 1, layer), 0u);
    const Result large = LayerRun{int64, 64, {}}({{1e30f, 1, 1, 1, 1, 1e-5f, 0, 1}});
    EXPECT_EQ(large.diag[DIAG_layer_saturated], 3u) << "in red, weighted or not";
    EXPECT_EQ(large.sum(1, 1, layer_of_unweighted(set, 0, 1)), std::uint64_t(SPLAT_FIXED_MAX));
    EXPECT_EQ(large.sum(1, 1, layer_of_unweighted(set, 0, 1), 1), std::uint64_t(scale));
    // A sum that is almost full.
    std::vector<uint> full(Layers(set, scale, side * side).words.size(), 0xffffffffu);
    const Result over = LayerRun{int64, 64, full}({{1, 1, 1, 1, 1, 1, 0, 4}});
    EXPECT_EQ(over.diag[DIAG_layer_saturated], 7u)
        << "two layers of three channels, and the number of vertices";
  }
}

}  // namespace
}  // namespace pellucid

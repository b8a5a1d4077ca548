// Layers: their numbering leaves no hole and no overlap, and their sums become channels.
#include "render/layers.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "base/error.h"

namespace pellucid {
namespace {

constexpr uint kinds_of_all = LAYERS_LENGTH | LAYERS_TECH | LAYERS_VERTICES | LAYERS_MERGE |
                              LAYERS_PHOTONS | LAYERS_CELLS | LAYERS_RADIUS;

TEST(Layers, every_layer_has_one_number) {
  for (uint kinds = 1; kinds <= kinds_of_all; ++kinds)
    for (uint longest : {1u, 2u, 3u, 7u, LAYER_LENGTH_MAX}) {
      if (kinds & LAYERS_MERGE && !(kinds & LAYERS_TECH)) continue;
      for (uint most_s = 0; most_s <= longest; ++most_s) {
        const uint set = layer_set_of(kinds, longest, most_s);
        ASSERT_EQ(layer_kinds(set), kinds);
        ASSERT_EQ(layer_longest(set), longest);
        ASSERT_EQ(layer_most_s(set), most_s);
        std::vector<uint> numbers;
        if (kinds & LAYERS_LENGTH)
          for (uint depth = 1; depth <= longest + 1; ++depth)
            numbers.push_back(layer_of_length(set, depth));
        if (kinds & LAYERS_TECH) {
          for (uint depth = 1; depth <= longest; ++depth)
            for (uint s = 0; s <= std::min(depth == 1 ? 0 : depth, most_s); ++s) {
              numbers.push_back(layer_of_weighted(set, s, depth));
              numbers.push_back(layer_of_unweighted(set, s, depth));
            }
          numbers.push_back(layer_of_weighted(set, 0, longest + 1));
        }
        for (uint k = 1; k <= longest && kinds & LAYERS_MERGE; ++k) {
          numbers.push_back(layer_of_merge(set, k));
          numbers.push_back(layer_of_merge_unweighted(set, k));
        }
        if (kinds & LAYERS_VERTICES) numbers.push_back(layer_of_vertices(set));
        if (kinds & LAYERS_PHOTONS) numbers.push_back(layer_of_photons(set));
        if (kinds & LAYERS_CELLS) numbers.push_back(layer_of_cells(set));
        if (kinds & LAYERS_RADIUS) numbers.push_back(layer_of_radius(set));
        ASSERT_EQ(numbers.size(), layer_count(set));
        const std::set<uint> all(numbers.begin(), numbers.end());
        ASSERT_EQ(all.size(), numbers.size()) << "no two share one";
        ASSERT_EQ(*all.rbegin(), numbers.size() - 1) << "none is left out";
        // Whatever is longer shares a layer.
        ASSERT_EQ(layer_of_length(set, 9999), layer_of_length(set, longest + 1));
        ASSERT_EQ(layer_of_weighted(set, most_s, 9999), layer_of_weighted(set, 0, longest + 1));
      }
    }
  EXPECT_EQ(layer_count(0), 0u);
}

TEST(Layers, all_strategies_of_the_pyramid) {
  // s + t - 1 = 1, 2, 3 without s = t = 1: 1 + 3 + 4.
  std::vector<std::string> names;
  for (const LayerChannel& channel : layer_channels(layer_set_of(LAYERS_TECH, 3, 3)))
    if (channel.name.back() == 'R') names.push_back(channel.name);
  std::vector<std::string> expected;
  for (const char* s : {"s0t2", "s0t3", "s1t2", "s2t1", "s0t4", "s1t3", "s2t2", "s3t1"}) {
    expected.push_back(std::string("tech.") + s + ".R");
    expected.push_back(std::string("tech.") + s + ".unweighted.R");
  }
  expected.push_back("tech.rest.R");
  EXPECT_EQ(names, expected);
}

TEST(Layers, a_method_keeps_them_in_the_passes_that_gather) {
  Integrator method;
  method.passes = {{"walk", {Bundle::scene, Bundle::film, Bundle::diag}, Domain::tile, true},
                   {"add", {Bundle::film, Bundle::diag}}};
  method.most_s = 1;
  EXPECT_EQ(with_layers(method, 0, 5).layers, 0u);
  EXPECT_EQ(describe_layers(0), "none");
  const Integrator kept = with_layers(method, LAYERS_TECH, 5);
  EXPECT_TRUE(kept.wishes.has(INTG_LAYERS));
  EXPECT_EQ(kept.passes[0].bundles,
            (std::vector<Bundle>{Bundle::scene, Bundle::film, Bundle::layers, Bundle::diag}));
  EXPECT_EQ(kept.passes[1].bundles, method.passes[1].bundles);
  EXPECT_EQ(describe_layers(kept.layers), "tech to length 5, s to 1");
  EXPECT_EQ(layer_bytes(kept.layers), (2 * 9 + 1) * 24u);
  EXPECT_EQ(layer_most_s(with_layers(method, LAYERS_TECH, 1).layers), 1u);
}

TEST(Layers, sums_become_means) {
  constexpr std::size_t pixels = 3;
  const uint set = layer_set_of(kinds_of_all, 2, 2);
  Layers layers(set, 0x1p20f, pixels);
  for (std::size_t i = 0; i < layers.words.size(); i += 2) layers.words[i] = uint(i);
  const std::size_t place = 2 * layers.words_per_pixel() + 2 + LAYER_WORDS;  // pixel 2, length 2, G
  layers.words[place] = 5, layers.words[place + 1] = 1u << 20;
  const std::size_t vertices = layers.words_per_pixel() + layer_of_vertices(set) * LAYER_WORDS;
  layers.words[vertices] = 12;
  layers.words[layer_of_radius(set) * LAYER_WORDS] = uint(3 * LAYER_RADIUS_STEPS);
  layers.words[layer_of_cells(set) * LAYER_WORDS + LAYER_CELL_PARITY] = 2;
  std::map<std::string, std::vector<float>> images;
  for (const AovChannel& image : layer_images(layers, 8)) images[image.name] = image.data;
  ASSERT_EQ(images.at("length.2.G").size(), pixels);
  EXPECT_EQ(images.at("length.2.G")[2], float((0x1p52 + 5) / 0x1p20 / 8));
  EXPECT_EQ(images.at("length.1.R")[1], float(double(layers.words_per_pixel()) / 0x1p20 / 8));
  EXPECT_EQ(images.at("light.vertices")[1], 1.5f) << "12 in 8 passes";
  EXPECT_EQ(images.at("radius")[0], 0.375f) << "3 pixels in 8 passes";
  EXPECT_EQ(images.at("cells.parity")[0], 2.0f) << "of one pass";
  EXPECT_EQ(images.size(), 3 * layer_count(set) - 6)
      << "vertices, photons and the radius are one channel each";
  EXPECT_EQ(layer_images(layers, 0)[0].data.size(), pixels) << "no passes yet";
}

TEST(Layers, merged_sums_carry) {
  const uint set = layer_set_of(LAYERS_LENGTH, 1, 0);
  Layers a(set, 1.0f, 1), b(set, 1.0f, 1);
  a.words = {0xffffffffu, 0, 1, 2, 0, 0x80000000u, 0, 0, 0, 0, 0, 0};
  b.words = {1, 7, 3, 4, 0, 0x7fffffffu, 0, 0, 0, 0, 0, 0};
  a.merge(b);
  EXPECT_EQ(a.words, (std::vector<uint>{0, 8, 4, 6, 0, 0xffffffffu, 0, 0, 0, 0, 0, 0}));
  EXPECT_THROW(a.merge(a), InternalError) << "beyond 64 bits";
  EXPECT_THROW(a.merge(Layers()), InternalError);
  EXPECT_THROW(a.merge(Layers(set, 2.0f, 1)), InternalError);
}

}  // namespace
}  // namespace pellucid

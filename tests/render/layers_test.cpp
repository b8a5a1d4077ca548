// Layers of real renders: they add up to the picture, agree between methods bit for bit, and do not
// depend on how passes and pixels were split.
#include "render/layers.h"
#include "render/launch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "integrators/registry.h"
#include "render_harness.h"
#include "shared/limits.h"
#include "support/kernel_folder.h"

namespace pellucid::test {
namespace {

constexpr int side = 24;
constexpr uint longest = 4;
const char* const methods[] = {"naive", "nee", "path", "light", "bdpt", "sppm", "vcm"};
constexpr PassRange all_passes{0, 37};  // neither a power of two nor whole blocks

const PackedScene& everything() {
  static const PackedScene packed = [] {
    Scene scene = scene_named("everything");
    scene.settings.width = scene.settings.height = side;
    return pack_scene(scene, {simd_width_for(test_device().info())});
  }();
  return packed;
}

RenderOptions options_for(PassRange passes, std::uint64_t seed = 11) {
  RenderOptions o;
  o.width = o.height = side;
  o.passes = passes;
  o.seed = seed;
  o.plan.extra_features = all_scene_features();  // one program for all tests
  o.plan.kernel_dir = kernel_folder();
  return o;
}

Integrator method_of(const std::string& name, uint kinds = LAYERS_LENGTH | LAYERS_TECH) {
  return with_layers(find_integrator(name), kinds, longest);
}

Film render(const Integrator& method, const RenderOptions& options,
            std::optional<Film> start = {}) {
  Session session(test_device(), everything(), method, options, std::move(start));
  EXPECT_TRUE(session.run({}));
  EXPECT_EQ(error_count(session.counters()), 0u) << describe_counters(session.counters());
  Film film = session.film();
  film.set_aside();
  return film;
}

std::uint64_t sum_at(const Film& film, std::size_t pixel, uint layer, std::size_t channel) {
  const std::size_t word =
      pixel * film.layers.words_per_pixel() + layer * LAYER_WORDS + 2 * channel;
  return std::uint64_t{film.layers.words[word + 1]} << 32 | film.layers.words[word];
}

/// Sum of a layer in all pixels and channels, as radiance.
double total(const Film& film, uint layer) {
  double sum = 0;
  for (std::size_t i = 0; i < film.pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) sum += double(sum_at(film, i, layer, c));
  return sum / double(film.layers.scale);
}

/// Whether two layers of two films hold the same sums.
bool same_layer(const Film& a, uint of_a, const Film& b, uint of_b) {
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      if (sum_at(a, i, of_a, c) != sum_at(b, i, of_b, c)) return false;
  return total(a, of_a) > 0;
}

TEST(LayersOf, add_up_to_the_picture) {
  const double splat_scale = make_launch(everything(), side, side, {0, 0, side, side}).splat_scale;
  for (const char* name : methods) {
    const Film film = render(method_of(name), options_for(all_passes));
    const uint set = film.layers.set;
    double most = 0;
    for (std::size_t i = 0; i < film.pixels.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        std::uint64_t lengths = 0, strategies = 0;
        for (uint depth = 1; depth <= longest + 1; ++depth)
          lengths += sum_at(film, i, layer_of_length(set, depth), c);
        const bool merges = layer_kinds(set) & LAYERS_MERGE;
        for (uint k = 1; merges && k <= longest; ++k)
          strategies += sum_at(film, i, layer_of_merge(set, k), c);
        for (uint depth = 1; depth <= longest; ++depth) {
          std::uint64_t of_depth = 0;
          for (uint s = 0; s < layer_strategies(set, depth); ++s)
            of_depth += sum_at(film, i, layer_of_weighted(set, s, depth), c);
          if (!merges) {  // which are of any length
            ASSERT_EQ(of_depth, sum_at(film, i, layer_of_length(set, depth), c))
                << name << ": the strategies of a length are all of it, to the last step";
          }
          strategies += of_depth;
        }
        strategies += sum_at(film, i, layer_of_weighted(set, 0, longest + 1), c);
        ASSERT_EQ(strategies, lengths) << name;
        const double picture = film.sums(i).sum[c], layers = double(lengths) / film.layers.scale;
        // A path's contributions are rounded to steps here, and to floats where its radiance adds
        // up: some roundings per path, whose signs are random. Two half steps and four roundings
        // of a float per path are more than they add up to. Splats have steps of their own.
        const double steps = 1 / double(film.layers.scale) + 1 / splat_scale;
        const double bound = 37 * steps + 4.0 * double(UNIT_ROUNDOFF) * picture;
        ASSERT_NEAR(layers, picture, bound) << name << " pixel " << i;
        most = std::max(most, std::abs(layers - picture) / bound);
      }
    std::printf("%s: the largest difference is %.2g of its bound\n", name, most);
  }
}

TEST(LayersOf, do_not_change_the_picture) {
  for (const char* name : methods) {
    Film film = render(method_of(name), options_for(all_passes));
    film.layers = {};
    EXPECT_TRUE(same_film(film, render(find_integrator(name), options_for(all_passes)))) << name;
  }
}

// Walks draw the same numbers in every method, and a strategy alone has weight 1: what `path` found
// by chance is what `naive` finds, to the last bit, and its light samples are those of `nee`.
TEST(LayersOf, a_strategy_alone_is_the_method_that_has_it_alone) {
  const Film naive = render(method_of("naive"), options_for(all_passes));
  const Film nee = render(method_of("nee"), options_for(all_passes));
  const Film path = render(method_of("path"), options_for(all_passes));
  for (uint depth = 1; depth <= longest; ++depth) {
    const uint chance = layer_of_weighted(naive.layers.set, 0, depth);
    const uint set = path.layers.set;
    for (const Film* film : {&path, &nee})
      EXPECT_TRUE(same_layer(*film, layer_of_unweighted(set, 0, depth), naive, chance)) << depth;
    if (depth == 1) continue;
    EXPECT_FALSE(same_layer(path, layer_of_weighted(set, 0, depth), naive, chance))
        << depth << ": weights must matter";
    const uint light = layer_of_unweighted(set, 1, depth);
    EXPECT_TRUE(same_layer(path, light, nee, light)) << depth;
    EXPECT_TRUE(same_layer(nee, light, nee, layer_of_weighted(set, 1, depth)))
        << depth << ": `nee` takes them as they are";
  }
  EXPECT_EQ(layer_count(naive.layers.set), 5u + 5u + 4u) << "no layers for strategies it lacks";
}

// `bdpt` walks from both ends as the other methods do from one.
TEST(LayersOf, bdpt_has_the_strategies_of_other_methods) {
  const Film nee = render(method_of("nee"), options_for(all_passes));
  const Film light = render(method_of("light"), options_for(all_passes));
  const Film bdpt = render(method_of("bdpt"), options_for(all_passes));
  const uint set = bdpt.layers.set;
  for (uint depth = 1; depth <= longest; ++depth) {
    const auto same = [&](uint s, const Film& other) {
      return same_layer(bdpt, layer_of_unweighted(set, s, depth), other,
                        layer_of_unweighted(other.layers.set, s, depth));
    };
    EXPECT_TRUE(same(0, nee)) << depth;
    if (depth == 1) continue;
    EXPECT_TRUE(same(1, nee)) << depth;
    EXPECT_TRUE(same(depth, light)) << depth;
    for (uint s = 2; s < depth; ++s)
      EXPECT_GT(total(bdpt, layer_of_weighted(set, s, depth)), 0.0) << s << ", " << depth;
  }
}

// `vcm` walks as `bdpt` does; `sppm` merges at the first vertex of an eye path that is not followed
// by delta lobes alone.
TEST(LayersOf, vcm_has_the_strategies_of_bdpt) {
  const Film bdpt = render(method_of("bdpt"), options_for(all_passes));
  const Film vcm = render(method_of("vcm"), options_for(all_passes));
  const uint of_bdpt = bdpt.layers.set, of_vcm = vcm.layers.set;
  for (uint depth = 1; depth <= longest; ++depth)
    for (uint s = 0; s < layer_strategies(of_bdpt, depth); ++s) {
      EXPECT_TRUE(same_layer(vcm, layer_of_unweighted(of_vcm, s, depth), bdpt,
                             layer_of_unweighted(of_bdpt, s, depth)))
          << s << ", " << depth;
      EXPECT_LE(total(vcm, layer_of_weighted(of_vcm, s, depth)),
                total(bdpt, layer_of_weighted(of_bdpt, s, depth)))
          << s << ", " << depth << ": merges leave less to it";
    }
  for (uint k = 1; k <= longest; ++k) {
    const double weighted = total(vcm, layer_of_merge(of_vcm, k)),
                 alone = total(vcm, layer_of_merge_unweighted(of_vcm, k));
    EXPECT_GT(weighted, 0.0) << k;
    EXPECT_LT(weighted, alone) << k;
  }
}

// Walks do not know how long paths may become, so those of one length bring the same bits whether
// longer ones are asked for or not, and none of these comes through if they are not.
TEST(LayersOf, a_length_is_the_same_whatever_is_longer) {
  for (const char* name : {"path", "light", "bdpt", "sppm", "vcm"}) {
    const Integrator method = method_of(name, LAYERS_LENGTH);
    RenderOptions capped = options_for(all_passes);
    capped.max_depth = longest;  // of fewer than four segments no two sub-paths join to too many
    const Film all = render(method, options_for(all_passes)), film = render(method, capped);
    const uint set = all.layers.set;
    for (uint depth = 1; depth <= longest; ++depth)
      EXPECT_TRUE(same_layer(all, layer_of_length(set, depth), film, layer_of_length(set, depth)))
          << name << ", length " << depth;
    const uint longer = layer_of_length(set, longest + 1);
    EXPECT_GT(total(all, longer), 0.0) << name;
    EXPECT_EQ(total(film, longer), 0.0) << name;
  }
}

class LayersSplit : public ::testing::TestWithParam<const char*> {};

TEST_P(LayersSplit, any_way) {
  const char* name = GetParam();
  const Integrator method = method_of(name);
  const Film whole = render(method, options_for(all_passes));
  const Film first = render(method, options_for({0, 13}));
  EXPECT_TRUE(same_film(whole, render(method, options_for(all_passes), first)))
      << name << " resumed";
  Film merged = render(method, options_for({20, 37}));
  merged.merge(first);
  merged.merge(render(method, options_for({13, 20})));
  EXPECT_TRUE(same_film(whole, merged)) << name << " merged";
  EXPECT_FALSE(whole.layers == first.layers);

  RenderOptions o = options_for(all_passes);
  o.memory = 0;
  for (const auto& [buffer, size] : buffer_sizes(everything(), method, o, 5)) *o.memory += size;
  EXPECT_EQ(plan_memory(test_device().info(), everything(), method, o).tiles.size(), 5u)
      << "layers count";
  EXPECT_TRUE(whole.layers == render(method, o).layers) << name << " in bands";
  RenderOptions other = options_for(all_passes);
  other.plan.group = 8;  // also of 1: device/layers_test.cpp, and the picture's in exact_test.cpp
  EXPECT_TRUE(same_film(whole, render(method, other))) << name << ", groups of 8";
}
INSTANTIATE_TEST_SUITE_P(Of, LayersSplit, ::testing::Values("path", "bdpt", "vcm"));

TEST(LayersOf, a_crop_is_a_part_of_the_whole) {
  const Integrator method = method_of("path");
  const Film whole = render(method, options_for(all_passes));
  RenderOptions o = options_for(all_passes);
  o.crop = Window{5, 3, 11, 17};
  const Film part = render(method, o);
  const std::size_t stride = part.layers.words_per_pixel();
  for (int y = 0; y < 17; ++y)
    for (int x = 0; x < 11; ++x)
      for (std::size_t w = 0; w < stride; ++w)
        ASSERT_EQ(part.layers.words[std::size_t(y * 11 + x) * stride + w],
                  whole.layers.words[std::size_t((y + 3) * side + x + 5) * stride + w]);
}

}  // namespace
}  // namespace pellucid::test

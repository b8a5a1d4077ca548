// Names and sums of layers.
#include "render/layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/error.h"
#include "base/text.h"
#include "image/atlas.h"
#include "image/heat_map.h"

namespace pellucid {
namespace {

constexpr const char* rest = "rest";  // what is longer than the longest length of its own

std::string strategy_name(uint s, uint depth) {
  return fmt::format("s{}t{}", s, depth + 1 - s);
}

void add_colour(const std::string& name, uint layer, std::vector<LayerChannel>& channels) {
  for (std::size_t c = 0; c < 3; ++c)
    channels.push_back(
        {fmt::format("{}.{}", name, "RGB"[c]), layer * LAYER_WORDS + 2 * c, LayerUnit::radiance});
}

/// Calls `visit(s, depth)` for every strategy that has layers of its own.
template <typename Visit>
void for_each_strategy(uint set, const Visit& visit) {
  for (uint depth = 1; depth <= layer_longest(set); ++depth)
    for (uint s = 0; s < layer_strategies(set, depth); ++s) visit(s, depth);
}

double sum_at(const Layers& layers, std::size_t word) {
  const std::uint64_t low = layers.words[word], high = layers.words[word + 1];
  return double(high << 32 | low);
}

/// What a step of the channel stands for in the mean over so many passes.
double unit_of(const LayerChannel& channel, const Layers& layers, std::uint64_t passes) {
  const double mean = 1.0 / double(std::max<std::uint64_t>(passes, 1));
  switch (channel.unit) {
    case LayerUnit::radiance:
      return mean / double(layers.scale);
    case LayerUnit::count:
      return mean;
    case LayerUnit::radius:
      return mean / double(LAYER_RADIUS_STEPS);
    case LayerUnit::first:
      break;
  }
  return 1.0;
}

}  // namespace

const std::vector<LayerInfo>& layer_table() {
  static const std::vector<LayerInfo> table{
      {"length", LAYERS_LENGTH, "radiance by path length"},
      {"tech", LAYERS_TECH, "radiance by strategy, weighted and not"},
      {"light-vertices", LAYERS_VERTICES, "light vertices that the camera sees, per pass",
       INTG_SPLAT, "makes no light vertices"},
      {"photons", LAYERS_PHOTONS,
       "photons within the radius where the pixel first gathers them, per pass", INTG_MERGE,
       "gathers no photons"},
      {"cells", LAYERS_CELLS, "photons in the grid's cell there, in pass 0", INTG_MERGE,
       "has no photon grid"},
      {"radius", LAYERS_RADIUS, "radius of merging there, in pixels, mean of passes", INTG_MERGE,
       "merges nothing"},
  };
  return table;
}

Integrator with_layers(Integrator method, uint kinds, uint longest) {
  if (!kinds) return method;
  PELLUCID_CHECK(longest >= 1 && longest <= LAYER_LENGTH_MAX, "a length that layers have");
  method.wishes.set(INTG_LAYERS);
  if (kinds & LAYERS_TECH && method.wishes.has(INTG_MERGE)) kinds |= LAYERS_MERGE;
  method.layers = layer_set_of(kinds, longest, std::min(method.most_s, longest));
  method.add_to_gathering(Bundle::layers);
  return method;
}

std::size_t layer_bytes(uint set) {
  return set ? layer_count(set) * LAYER_WORDS * sizeof(uint) : 0;
}

std::string describe_layers(uint set) {
  if (!set) return "none";
  std::vector<std::string> kinds;
  for (const LayerInfo& info : layer_table())
    if (layer_kinds(set) & info.kind) kinds.push_back(info.name);
  return fmt::format("{} to length {}, s to {}", join(kinds, " "), layer_longest(set),
                     layer_most_s(set));
}

Layers::Layers(uint of, float steps, std::size_t pixels)
    : set(of), scale(of ? steps : 1.0f), words(pixels * layer_bytes(of) / sizeof(uint)) {}

void Layers::merge(const Layers& other) {
  PELLUCID_CHECK(set == other.set && scale == other.scale && words.size() == other.words.size(),
                 "layers of the same picture");
  for (std::size_t i = 0; i < words.size(); i += 2) {
    const std::uint64_t a = std::uint64_t{words[i + 1]} << 32 | words[i];
    const std::uint64_t b = std::uint64_t{other.words[i + 1]} << 32 | other.words[i];
    PELLUCID_CHECK(a + b >= a, "sums of layers fit 64 bits");
    words[i] = uint(a + b), words[i + 1] = uint((a + b) >> 32);
  }
}

std::vector<LayerChannel> layer_channels(uint set) {
  std::vector<LayerChannel> channels;
  const uint kinds = layer_kinds(set), longest = layer_longest(set);
  if (kinds & LAYERS_LENGTH) {
    for (uint depth = 1; depth <= longest; ++depth)
      add_colour(fmt::format("length.{}", depth), layer_of_length(set, depth), channels);
    add_colour(fmt::format("length.{}", rest), layer_of_length(set, longest + 1), channels);
  }
  if (kinds & LAYERS_TECH) {
    for_each_strategy(set, [&](uint s, uint depth) {
      const std::string name = "tech." + strategy_name(s, depth);
      add_colour(name, layer_of_weighted(set, s, depth), channels);
      add_colour(name + ".unweighted", layer_of_unweighted(set, s, depth), channels);
    });
    add_colour(fmt::format("tech.{}", rest), layer_of_weighted(set, 0, longest + 1), channels);
  }
  for (uint k = 1; k <= longest && kinds & LAYERS_MERGE; ++k) {
    const std::string name = fmt::format("merge.k{}", k);
    add_colour(name, layer_of_merge(set, k), channels);
    add_colour(name + ".unweighted", layer_of_merge_unweighted(set, k), channels);
  }
  const auto add = [&](uint kind, const char* name, uint layer, uint word, LayerUnit unit) {
    if (kinds & kind) channels.push_back({name, layer * LAYER_WORDS + word, unit});
  };
  const uint cells = layer_of_cells(set);
  add(LAYERS_VERTICES, "light.vertices", layer_of_vertices(set), 0, LayerUnit::count);
  add(LAYERS_PHOTONS, "photons", layer_of_photons(set), 0, LayerUnit::count);
  add(LAYERS_CELLS, "cells.photons", cells, LAYER_CELL_PHOTONS, LayerUnit::first);
  add(LAYERS_CELLS, "cells.bucket", cells, LAYER_CELL_BUCKET, LayerUnit::first);
  add(LAYERS_CELLS, "cells.parity", cells, LAYER_CELL_PARITY, LayerUnit::first);
  add(LAYERS_RADIUS, "radius", layer_of_radius(set), 0, LayerUnit::radius);
  return channels;
}

std::vector<AovChannel> layer_images(const Layers& layers, std::uint64_t passes) {
  std::vector<AovChannel> images;
  const std::size_t stride = layers.words_per_pixel();
  for (const LayerChannel& channel : layer_channels(layers.set)) {
    const double unit = unit_of(channel, layers, passes);
    AovChannel image{channel.name, {}};
    image.data.reserve(layers.words.size() / stride);
    for (std::size_t word = channel.word; word < layers.words.size(); word += stride)
      image.data.push_back(float(sum_at(layers, word) * unit));
    images.push_back(std::move(image));
  }
  return images;
}

Image strategy_atlas(const Layers& layers, int width, int height, std::uint64_t passes) {
  PELLUCID_CHECK(layer_kinds(layers.set) & LAYERS_TECH, "an atlas is made of strategies");
  const std::size_t stride = layers.words_per_pixel();
  const double unit = 1.0 / (double(layers.scale) * double(std::max<std::uint64_t>(passes, 1)));
  std::vector<AtlasCell> cells;
  const auto add = [&](bool weighted, uint row, uint column, const std::string& label, uint layer) {
    AtlasCell cell{weighted, int(row), int(column), label, {}};
    cell.rgb.reserve(3 * layers.words.size() / stride);
    for (std::size_t first = layer * LAYER_WORDS; first < layers.words.size(); first += stride)
      for (std::size_t c = 0; c < 3; ++c)
        cell.rgb.push_back(float(sum_at(layers, first + 2 * c) * unit));
    cells.push_back(std::move(cell));
  };
  const uint set = layers.set, longest = layer_longest(set);
  for_each_strategy(set, [&](uint s, uint depth) {
    const std::string label = fmt::format("s={} t={}", s, depth + 1 - s);
    add(true, depth - 1, s, label, layer_of_weighted(set, s, depth));
    add(false, depth - 1, s, label, layer_of_unweighted(set, s, depth));
  });
  add(true, longest, 0, "all", layer_of_weighted(set, 0, longest + 1));
  std::vector<std::string> rows;
  for (uint depth = 1; depth <= longest; ++depth) rows.push_back(fmt::format("length {}", depth));
  rows.push_back("longer");
  if (layer_kinds(set) & LAYERS_MERGE) {
    rows.push_back("merged");
    for (uint k = 1; k <= longest; ++k) {
      const std::string label = fmt::format("k={}", k);
      add(true, longest + 1, k - 1, label, layer_of_merge(set, k));
      add(false, longest + 1, k - 1, label, layer_of_merge_unweighted(set, k));
    }
  }
  return draw_atlas(width, height, rows, cells);
}

Image grid_picture(const Layers& layers, int width, int height, std::uint64_t passes) {
  PELLUCID_CHECK((layer_kinds(layers.set) & LAYERS_GRID) == LAYERS_GRID, "layers of the grid");
  std::map<std::string, std::vector<float>> of;
  for (AovChannel& image : layer_images(layers, passes)) of[image.name] = std::move(image.data);
  return draw_heat_maps(
      width, height,
      {{"photons found, per pass", of.at("photons"), {}},
       {"photons in the cell, pass 0", of.at("cells.photons"), of.at("cells.parity")},
       {"radius in pixels", of.at("radius"), {}}});
}

}  // namespace pellucid

// Sums and noise by path length, and how they are weighed.
#include "explain/evidence.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "explain/noise.h"
#include "image/image_pair.h"

namespace pellucid::explain {
namespace {

/// What a right cause may leave of a cell: half a percent, and a part of the mean cell however dark
/// it is. A cause that is off everywhere by less still shows, since cells are many.
constexpr double OF_VALUE = 0.005, OF_MEAN = 1e-3;

/// Variance over squares of what counts as one cell, at most.
constexpr double MOST_NOISE = 0.05;

Sums tolerances(const Sums& known, const Sums& other) {
  const double mean =
      (std::abs(energy(known)) + std::abs(energy(other))) / 2 / double(known.size());
  Sums squares;
  for (std::size_t j = 0; j < known.size(); ++j) {
    const double off = OF_VALUE * std::max(std::abs(known[j]), std::abs(other[j])) + OF_MEAN * mean;
    squares.push_back(off * off);
  }
  return squares;
}

/// Noise of the known picture to its layers, as they vary.
void share_noise(const Layered& known, const Sums& noise, Evidence& e) {
  Layers own;
  Sums all(noise.size());
  for (std::size_t layer = 0; layer < e.lengths(); ++layer) {
    own.push_back(roughness(e.grid, {known, layer, layer + 1}));
    for (std::size_t j = 0; j < all.size(); ++j) all[j] += own.back()[j];
  }
  for (Sums& layer : own) {
    for (std::size_t j = 0; j < all.size(); ++j) layer[j] = quotient(noise[j] * layer[j], all[j]);
    e.noise_known.push_back(std::move(layer));
  }
}

/// Sums of blocks in their first cells.
void gather_blocks(const Grid& grid, int side, Sums& sums) {
  Sums out(sums.size());
  for (std::size_t j = 0; j < sums.size(); ++j) {
    const int x = int(j % grid.cells()) % grid.columns, y = int(j % grid.cells()) / grid.columns;
    out[j / grid.cells() * grid.cells() +
        std::size_t(y / side * side * grid.columns + x / side * side)] += sums[j];
  }
  sums = std::move(out);
}

/// Puts cells of the group together until their light is well above noise: fits to what is mostly
/// noise depend on how well that is known.
void coarsen(std::size_t group, Evidence& e) {
  const std::size_t first = e.by_length() ? group : 0;
  const std::size_t last = e.by_length() ? group + 1 : e.lengths();
  for (;;) {
    double light = 0, noise = 0;
    for (std::size_t j = 0; j < e.other[group].size(); ++j) {
      double known = 0;
      for (std::size_t layer = first; layer < last; ++layer) {
        known += e.known[layer][j];
        noise += e.noise_known[layer][j];
      }
      noise += e.noise_other[group][j];
      light += known * known + e.other[group][j] * e.other[group][j];
    }
    int& side = e.block[group];
    if (noise <= MOST_NOISE * light || side >= std::max(e.grid.columns, e.grid.rows)) return;
    side *= 2;
    for (std::size_t layer = first; layer < last; ++layer) {
      gather_blocks(e.grid, side, e.known[layer]);
      gather_blocks(e.grid, side, e.noise_known[layer]);
    }
    gather_blocks(e.grid, side, e.other[group]);
    gather_blocks(e.grid, side, e.noise_other[group]);
  }
}

}  // namespace

Layers Evidence::grouped(const Layers& layers) const {
  if (by_length()) return layers;
  Layers one(1, Sums(layers.front().size()));
  for (const Sums& layer : layers)
    for (std::size_t j = 0; j < layer.size(); ++j) one.front()[j] += layer[j];
  return one;
}

std::size_t Evidence::observations(std::size_t group) const {
  const int side = block[group];
  return std::size_t((grid.columns + side - 1) / side) * std::size_t((grid.rows + side - 1) / side);
}

std::size_t Evidence::observations() const {
  std::size_t count = 0;
  for (std::size_t g = 0; g < block.size(); ++g) count += observations(g);
  return count;
}

std::size_t Evidence::cell(std::size_t layer, int x, int y) const {
  const int side = block[by_length() ? layer : 0] * grid.side;
  return grid.cell(x / side * side, y / side * side);
}

double Evidence::variance(std::size_t group, std::size_t j) const {
  double sum = noise_other[group][j] + tolerance[group][j];
  const std::size_t first = by_length() ? group : 0, last = by_length() ? group + 1 : lengths();
  for (std::size_t layer = first; layer < last; ++layer) sum += noise_known[layer][j];
  return sum;
}

double Evidence::misfit(const Layers& predicted, Channels channels,
                        const std::vector<char>& skipped, std::size_t direct) const {
  double sum = 0;
  for (std::size_t g = 0; g < other.size(); ++g)
    for (std::size_t j = channels.first * grid.cells(); j < channels.last * grid.cells(); ++j) {
      if (g < direct && skipped[j % grid.cells()]) continue;
      double value = 0, noise = noise_other[g][j] + tolerance[g][j];
      const std::size_t first = by_length() ? g : 0, last = by_length() ? g + 1 : lengths();
      for (std::size_t layer = first; layer < last; ++layer) {
        const double p = predicted[layer][j], k = known[layer][j];
        const double factor = k > 0 ? p / k : 1;
        value += p;
        noise += factor * factor * noise_known[layer][j];
      }
      const double off = other[g][j] - value;
      sum += quotient(off * off, noise);
    }
  return sum / double(channels.last - channels.first);
}

Evidence gather(const Layered& known, const Layered& other, bool by_length) {
  PELLUCID_CHECK(known.layers() >= 2, "layers to explain by");
  Evidence e{Grid(known.width(), known.height()), {}, {}, {}, {}, {}, {}};
  const std::size_t lengths = by_length ? std::min(known.layers(), other.layers()) : known.layers();
  const auto part = [&](const Layered& picture, std::size_t length) {
    return Part{picture, length, length + 1 == lengths ? picture.layers() : length + 1};
  };
  for (std::size_t length = 0; length < lengths; ++length)
    e.known.push_back(cell_sums(e.grid, part(known, length)));
  const Part whole{known, 0, 0}, whole_other{other, 0, 0};
  for (std::size_t g = 0; g < (by_length ? lengths : 1); ++g) {
    const Part a = by_length ? part(known, g) : whole;
    const Part b = by_length ? part(other, g) : whole_other;
    e.other.push_back(cell_sums(e.grid, b));
    Noise noise = noise_of(e.grid, a, b);
    e.noise_other.push_back(std::move(noise.other));
    if (by_length)
      e.noise_known.push_back(std::move(noise.known));
    else
      share_noise(known, noise.known, e);
    e.block.push_back(1);
  }
  for (std::size_t g = 0; g < e.other.size(); ++g) coarsen(g, e);
  const Layers groups = e.grouped(e.known);
  for (std::size_t g = 0; g < e.other.size(); ++g)
    e.tolerance.push_back(tolerances(groups[g], e.other[g]));
  return e;
}

}  // namespace pellucid::explain

// Channels by name, and sums over cells.
#include "explain/layered.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "image/image_pair.h"

namespace pellucid::explain {
namespace {

/// Most cells along a side, and fewest pixels along a cell's: enough neighbours to tell noise by.
constexpr int MOST_CELLS = 32, LEAST_SIDE = 4;

/// Indices of name.R, name.G, name.B; false if the picture lacks any.
bool find_colours(const Image& image, const std::string& name,
                  std::array<std::size_t, COLOURS>& found) {
  for (std::size_t c = 0; c < COLOURS; ++c) {
    const int index = image.channel(fmt::format("{}.{}", name, "RGB"[c]));
    if (index < 0) return false;
    found[c] = std::size_t(index);
  }
  return true;
}

}  // namespace

Layered::Layered(const Image& image) : image_(image) {
  const std::vector<std::size_t> colours = colour_channels(image);
  if (colours.size() != COLOURS)
    throw InputError("it has one channel, and to explain a difference takes R, G and B");
  std::copy(colours.begin(), colours.end(), colours_.begin());
  std::array<std::size_t, COLOURS> found;
  for (int length = 1; find_colours(image, fmt::format("length.{}", length), found); ++length)
    lengths_.push_back(found);
  if (!lengths_.empty() && find_colours(image, "length.rest", found))
    lengths_.push_back(found);
  else
    lengths_.clear();
}

bool Layered::adds_up() const {
  constexpr double part = 1e-3;
  for (std::size_t c = 0; c < COLOURS; ++c) {
    double whole = 0, sum = 0;
    for (std::size_t p = 0; p < pixels(); ++p) {
      whole += all(p, c);
      for (std::size_t layer = 0; layer < layers(); ++layer) sum += at(layer, p, c);
    }
    if (!(std::abs(whole - sum) <= part * std::abs(whole))) return false;
  }
  return true;
}

Grid::Grid(int picture_width, int picture_height)
    : width(picture_width),
      height(picture_height),
      side(std::max(LEAST_SIDE, (std::max(width, height) + MOST_CELLS - 1) / MOST_CELLS)),
      columns((width + side - 1) / side),
      rows((height + side - 1) / side) {}

Sums cell_sums(const Grid& grid, const Part& part) {
  Sums sums(COLOURS * grid.cells());
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x)
      for (std::size_t c = 0; c < COLOURS; ++c)
        sums[c * grid.cells() + grid.cell(x, y)] += part.at(grid.pixel(x, y), c);
  return sums;
}

double energy(const Grid& grid, const Sums& sums, std::size_t c) {
  const auto first = sums.begin() + std::ptrdiff_t(c * grid.cells());
  return std::accumulate(first, first + std::ptrdiff_t(grid.cells()), 0.0);
}

double energy(const Sums& sums) {
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

}  // namespace pellucid::explain

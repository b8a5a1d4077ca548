// Channels by name, cells, and noise from differences.
#include "explain/evidence.h"

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

/// What a right cause may leave of a cell: half a percent, and a part of the mean cell however dark
/// it is. A cause that is off everywhere by less still shows, since cells are many.
constexpr double OF_VALUE = 0.005, OF_MEAN = 1e-3;

/// Variance over squares of what counts as one cell, at most.
constexpr double MOST_NOISE = 0.05;

/// Median of the square of a standard normal number.
constexpr double MEDIAN_SQUARE = 0.454936;

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

/// Layers first ... last - 1 of a picture together; none: the picture itself.
struct Part {
  const Layered& picture;
  std::size_t first, last;

  double at(std::size_t pixel, std::size_t c) const {
    if (first == last) return picture.all(pixel, c);
    double value = 0;
    for (std::size_t layer = first; layer < last; ++layer) value += picture.at(layer, pixel, c);
    return value;
  }
};

Sums cell_sums(const Grid& grid, const Part& part) {
  Sums sums(COLOURS * grid.cells());
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x)
      for (std::size_t c = 0; c < COLOURS; ++c)
        sums[c * grid.cells() + grid.cell(x, y)] += part.at(grid.pixel(x, y), c);
  return sums;
}

/// Mean products of the steps between neighbours within a cell, half of which are variances.
struct Steps {
  Sums aa, ab, bb;
};

Steps steps_of(const Grid& grid, const Part& a, const Part& b) {
  const std::size_t size = COLOURS * grid.cells();
  Steps s{Sums(size), Sums(size), Sums(size)};
  std::vector<double> pairs(grid.cells());
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x)
      for (int way = 0; way < 2; ++way) {
        const int nx = x + (way == 0), ny = y + (way == 1);
        const std::size_t cell = grid.cell(x, y);
        if (nx >= grid.width || ny >= grid.height || grid.cell(nx, ny) != cell) continue;
        pairs[cell] += 2;
        for (std::size_t c = 0; c < COLOURS; ++c) {
          const std::size_t here = grid.pixel(x, y), next = grid.pixel(nx, ny);
          const double da = a.at(next, c) - a.at(here, c), db = b.at(next, c) - b.at(here, c);
          s.aa[c * grid.cells() + cell] += da * da;
          s.ab[c * grid.cells() + cell] += da * db;
          s.bb[c * grid.cells() + cell] += db * db;
        }
      }
  for (Sums* sums : {&s.aa, &s.ab, &s.bb})
    for (std::size_t j = 0; j < size; ++j)
      (*sums)[j] = quotient((*sums)[j], std::max(1.0, pairs[j % grid.cells()]));
  return s;
}

/// Variances of one pixel of a cell.
struct Noise {
  Sums known, other;
};

/// The part of the steps that is left of b - r a.
double left_of(const Steps& s, std::size_t j, double r) {
  const double both = s.bb[j] + r * r * s.aa[j];
  return both > 0 ? std::max(0.0, both - 2 * r * s.ab[j]) / both : 0;
}

/// How many times as noisy as the known picture the other one is, in a channel: the median of the
/// cells in which both are, since a single bright path tells nothing of others.
double noise_ratio(const Steps& s, std::size_t first, std::size_t last) {
  std::vector<double> ratios;
  double all_a = 0, all_b = 0;
  for (std::size_t j = first; j < last; ++j) {
    all_a += s.aa[j], all_b += s.bb[j];
    if (s.aa[j] > 0 && s.bb[j] > 0) ratios.push_back(s.bb[j] / s.aa[j]);
  }
  if (ratios.empty()) return quotient(all_b, all_a);
  const auto middle = ratios.begin() + std::ptrdiff_t(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  return *middle;
}

/// The steps of each picture without what is common: that is what the cell shows, be it as bright
/// in both or r times. The variance of b - r a is v_b + r^2 v_a. Where noise is, both tell, the
/// quieter one more: cells that are dark by chance look quiet, too, and must not count for more
/// than those that are bright by chance.
Noise noise_of(const Grid& grid, const Steps& s, const Sums& known, const Sums& other) {
  Noise noise{s.aa, s.bb};
  for (std::size_t c = 0; c < COLOURS; ++c) {
    const std::size_t first = c * grid.cells(), last = first + grid.cells();
    const double q = noise_ratio(s, first, last);
    if (!(q > 0) || std::isinf(q)) continue;  // one of them is black: its steps are all there is
    for (std::size_t j = first; j < last; ++j) {
      const double r = known[j] > 0 ? std::max(0.0, other[j] / known[j]) : 0;
      const double left = r > 0 ? std::min({1.0, left_of(s, j, r), left_of(s, j, 1)}) : 1;
      const double of_known = (q * s.aa[j] + s.bb[j] / q) / (1 + q);
      noise.known[j] = of_known * left;
      noise.other[j] = q * of_known * left;
    }
  }
  return noise;
}

/// Means over a cell and those around it, since what a cell shows by chance must not weigh it.
Sums smooth(const Grid& grid, const Sums& in) {
  Sums out(in.size());
  for (std::size_t j = 0; j < out.size(); ++j) {
    const std::size_t c = j / grid.cells(), i = j % grid.cells();
    const int x = int(i) % grid.columns, y = int(i) / grid.columns;
    double count = 0;
    for (int ny = std::max(0, y - 1); ny <= std::min(grid.rows - 1, y + 1); ++ny)
      for (int nx = std::max(0, x - 1); nx <= std::min(grid.columns - 1, x + 1); ++nx) {
        out[j] += in[c * grid.cells() + std::size_t(ny * grid.columns + nx)];
        count += 1;
      }
    out[j] /= count;
  }
  return out;
}

Steps smooth(const Grid& grid, const Steps& s) {
  return {smooth(grid, s.aa), smooth(grid, s.ab), smooth(grid, s.bb)};
}

/// How many times as much cells differ as their variances say: the median of second differences of
/// b - r a, r being the ratio of the three, so that what both show cancels. At least 1.
double spread_of_cells(const Grid& grid, const Sums& a, const Sums& b, const Noise& noise) {
  std::vector<double> ratios;
  const auto add = [&](std::size_t i, std::size_t step) {
    const double sum = a[i - step] + a[i] + a[i + step];
    const double r = sum > 0 ? std::max(0.0, (b[i - step] + b[i] + b[i + step]) / sum) : 0;
    const auto off = [&](std::size_t j) { return b[j] - r * a[j]; };
    const auto variance = [&](std::size_t j) { return noise.other[j] + r * r * noise.known[j]; };
    const double value = off(i - step) - 2 * off(i) + off(i + step);
    const double expected = variance(i - step) + 4 * variance(i) + variance(i + step);
    if (expected > 0) ratios.push_back(value * value / expected);
  };
  for (std::size_t c = 0; c < COLOURS; ++c)
    for (int y = 0; y < grid.rows; ++y)
      for (int x = 0; x < grid.columns; ++x) {
        const std::size_t i = c * grid.cells() + std::size_t(y * grid.columns + x);
        if (x > 0 && x + 1 < grid.columns) add(i, 1);
        if (y > 0 && y + 1 < grid.rows) add(i, std::size_t(grid.columns));
      }
  if (ratios.empty()) return 1;
  const auto middle = ratios.begin() + std::ptrdiff_t(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  return std::max(1.0, *middle / MEDIAN_SQUARE);
}

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

/// Noise of a group to the evidence: that of the known picture goes to its layers as they vary.
void add_noise(const Part& known, const Part& other, const Sums& of_known, const Sums& of_other,
               Evidence& e) {
  std::vector<double> pixels(e.grid.cells());
  for (int y = 0; y < e.grid.height; ++y)
    for (int x = 0; x < e.grid.width; ++x) pixels[e.grid.cell(x, y)] += 1;
  Noise noise = noise_of(e.grid, smooth(e.grid, steps_of(e.grid, known, other)),
                         smooth(e.grid, of_known), smooth(e.grid, of_other));
  for (Sums* sums : {&noise.known, &noise.other})
    for (std::size_t j = 0; j < sums->size(); ++j) (*sums)[j] *= pixels[j % pixels.size()];
  const double spread = spread_of_cells(e.grid, of_known, of_other, noise);
  for (Sums* sums : {&noise.known, &noise.other})
    for (double& v : *sums) v *= spread;
  e.noise_other.push_back(std::move(noise.other));
  if (e.by_length()) {
    e.noise_known.push_back(std::move(noise.known));
    return;
  }
  Layers own;
  Sums all(noise.known.size());
  for (std::size_t layer = 0; layer < e.lengths(); ++layer) {
    const Part part{known.picture, layer, layer + 1};
    own.push_back(smooth(e.grid, steps_of(e.grid, part, part).aa));
    for (std::size_t j = 0; j < all.size(); ++j) all[j] += own.back()[j];
  }
  for (Sums& layer : own) {
    for (std::size_t j = 0; j < all.size(); ++j)
      layer[j] = quotient(noise.known[j] * layer[j], all[j]);
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

Layers Evidence::grouped(const Layers& layers) const {
  if (by_length()) return layers;
  Layers one(1, Sums(layers.front().size()));
  for (const Sums& layer : layers)
    for (std::size_t j = 0; j < layer.size(); ++j) one.front()[j] += layer[j];
  return one;
}

std::size_t Evidence::observations(std::size_t group) const {
  const int side = block[group];
  return COLOURS * std::size_t((grid.columns + side - 1) / side) *
         std::size_t((grid.rows + side - 1) / side);
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
  return sum;
}

Evidence gather(const Layered& known, const Layered& other, bool by_length) {
  PELLUCID_CHECK(known.layers() >= 2, "layers to explain by");
  Evidence e{Grid(known.width(), known.height()), {}, {}, {}, {}, {}, {}};
  const std::size_t lengths = by_length ? std::min(known.layers(), other.layers()) : known.layers();
  const auto part = [&](const Layered& picture, std::size_t length) {
    return Part{picture, length, length + 1 == lengths ? picture.layers() : length + 1};
  };
  std::vector<Part> known_parts, other_parts;
  for (std::size_t length = 0; length < lengths; ++length) {
    e.known.push_back(cell_sums(e.grid, part(known, length)));
    if (by_length) known_parts.push_back(part(known, length));
    if (by_length) other_parts.push_back(part(other, length));
  }
  if (!by_length) {
    known_parts.push_back({known, 0, 0});
    other_parts.push_back({other, 0, 0});
  }
  for (const Part& p : other_parts) e.other.push_back(cell_sums(e.grid, p));
  const Layers known_groups = e.grouped(e.known);
  for (std::size_t g = 0; g < e.other.size(); ++g) {
    add_noise(known_parts[g], other_parts[g], known_groups[g], e.other[g], e);
    e.block.push_back(1);
  }
  for (std::size_t g = 0; g < e.other.size(); ++g) coarsen(g, e);
  const Layers groups = e.grouped(e.known);
  for (std::size_t g = 0; g < e.other.size(); ++g)
    e.tolerance.push_back(tolerances(groups[g], e.other[g]));
  return e;
}

double energy(const Grid& grid, const Sums& sums, std::size_t c) {
  const auto first = sums.begin() + std::ptrdiff_t(c * grid.cells());
  return std::accumulate(first, first + std::ptrdiff_t(grid.cells()), 0.0);
}

double energy(const Sums& sums) {
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

}  // namespace pellucid::explain

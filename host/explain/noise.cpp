// Steps between neighbouring pixels, and of neighbouring cells.
#include "explain/noise.h"

#include <algorithm>
#include <cmath>

#include "base/statistics.h"
#include "image/image_pair.h"

namespace pellucid::explain {
namespace {

/// Median of the square of a standard normal number.
constexpr double MEDIAN_SQUARE = 0.454936;

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
  return ratios.empty() ? quotient(all_b, all_a) : median_of(ratios);
}

/// Variances of a pixel: the steps of each picture without what is common: that is what the cell
/// shows, be it as bright in both or r times. The variance of b - r a is v_b + r^2 v_a. Where noise
/// is, both tell, the quieter one more: cells that are dark by chance look quiet, too, and must not
/// count for more than those that are bright by chance.
Noise of_pixels(const Grid& grid, const Steps& s, const Sums& known, const Sums& other) {
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
  return ratios.empty() ? 1 : std::max(1.0, median_of(ratios) / MEDIAN_SQUARE);
}

}  // namespace

Noise noise_of(const Grid& grid, const Part& known, const Part& other) {
  const Sums of_known = cell_sums(grid, known), of_other = cell_sums(grid, other);
  Noise noise = of_pixels(grid, smooth(grid, steps_of(grid, known, other)), smooth(grid, of_known),
                          smooth(grid, of_other));
  std::vector<double> pixels(grid.cells());
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x) pixels[grid.cell(x, y)] += 1;
  for (Sums* sums : {&noise.known, &noise.other})
    for (std::size_t j = 0; j < sums->size(); ++j) (*sums)[j] *= pixels[j % pixels.size()];
  const double spread = spread_of_cells(grid, of_known, of_other, noise);
  for (Sums* sums : {&noise.known, &noise.other})
    for (double& v : *sums) v *= spread;
  return noise;
}

Sums roughness(const Grid& grid, const Part& part) {
  return smooth(grid, steps_of(grid, part, part).aa);
}

}  // namespace pellucid::explain

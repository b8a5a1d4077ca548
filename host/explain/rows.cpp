// Energies by path length and by strategy.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "explain/explain.h"
#include "explain/least_squares.h"
#include "image/image_pair.h"

namespace pellucid::explain {
namespace {

/// Standard error of a ratio above which lengths are not told apart.
constexpr double APART = 0.1;

/// Layers first ... last - 1.
struct Range {
  std::size_t first, last;
};

std::string range_name(const Range& r, std::size_t lengths) {
  if (r.last == lengths) return fmt::format("{} and longer", r.first + 1);
  if (r.last == r.first + 1) return fmt::format("{}", r.first + 1);
  return fmt::format("{} to {}", r.first + 1, r.last);
}

double pixels(const Evidence& e) {
  return double(e.grid.width) * double(e.grid.height);
}

Row known_row(const Evidence& e, const Range& r) {
  Row row;
  row.name = range_name(r, e.lengths());
  for (std::size_t c = 0; c < COLOURS; ++c)
    for (std::size_t layer = r.first; layer < r.last; ++layer)
      row.known[c] += energy(e.grid, e.known[layer], c) / pixels(e);
  return row;
}

/// Of layers that both have.
Row measured_row(const Evidence& e, std::size_t layer, double inflation) {
  Row row = known_row(e, {layer, layer + 1});
  for (std::size_t c = 0; c < COLOURS; ++c) {
    row.other[c] = energy(e.grid, e.other[layer], c) / pixels(e);
    row.ratio[c] = quotient(row.other[c], row.known[c]);
    const double variance = energy(e.grid, e.noise_known[layer], c) * row.ratio[c] * row.ratio[c] +
                            energy(e.grid, e.noise_other[layer], c);
    row.error[c] = quotient(std::sqrt(inflation * variance) / pixels(e), row.known[c]);
  }
  return row;
}

/// By regression of each channel on the groups of lengths.
Rows regressed_rows(const Evidence& e, const std::vector<Range>& groups, double inflation) {
  Rows rows;
  for (const Range& r : groups) rows.push_back(known_row(e, r));
  const std::size_t cells = e.grid.cells();
  for (std::size_t c = 0; c < COLOURS; ++c) {
    LeastSquares fit(groups.size());
    std::vector<double> x(groups.size()), noise(groups.size());
    for (std::size_t i = 0; i < cells; ++i) {
      const std::size_t j = c * cells + i;
      for (std::size_t g = 0; g < groups.size(); ++g) {
        x[g] = noise[g] = 0;
        for (std::size_t layer = groups[g].first; layer < groups[g].last; ++layer) {
          x[g] += e.known[layer][j];
          noise[g] += e.noise_known[layer][j];
        }
      }
      const double variance = e.variance(0, j);
      if (variance > 0) fit.add(x, e.other.front()[j], 1 / variance, noise);
    }
    const LeastSquares::Solution s = fit.solve_non_negative();
    for (std::size_t g = 0; g < groups.size(); ++g) {
      rows[g].ratio[c] = s.value[g];
      rows[g].error[c] = s.error[g] * std::sqrt(inflation);
      rows[g].other[c] = s.value[g] * rows[g].known[c];
    }
  }
  return rows;
}

/// A group and its next longer neighbour (or the shorter one, of the last).
void merge_with_neighbour(std::vector<Range>& groups, std::size_t g) {
  const std::size_t first = g + 1 < groups.size() ? g : g - 1;
  groups[first].last = groups[first + 1].last;
  groups.erase(groups.begin() + std::ptrdiff_t(first) + 1);
}

/// Sum over the pixels of a channel, and the variance of the sum of the difference of two: by what
/// neighbours in a row differ by.
struct Total {
  double known = 0, other = 0, variance = 0;
};
Total total_of(const Image& a, std::size_t of_a, const Image& b, std::size_t of_b) {
  Total t;
  double squares = 0, pairs = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const std::size_t p = std::size_t(y) * std::size_t(a.width) + std::size_t(x);
      const auto off = [&](std::size_t i) {
        return double(b.data[i * b.channels.size() + of_b]) -
               double(a.data[i * a.channels.size() + of_a]);
      };
      t.known += double(a.data[p * a.channels.size() + of_a]);
      t.other += double(b.data[p * b.channels.size() + of_b]);
      if (x == 0) continue;
      const double step = off(p) - off(p - 1);
      squares += step * step;
      pairs += 1;
    }
  const double count = double(a.width) * double(a.height);
  t.variance = pairs > 0 ? count * squares / (2 * pairs) : 0;
  return t;
}

bool starts_with(const std::string& text, const std::string& what) {
  return text.compare(0, what.size(), what) == 0;
}

}  // namespace

double Row::all_error() const {
  double variance = 0;
  for (std::size_t c = 0; c < COLOURS; ++c)
    if (known[c] > 0) variance += error[c] * known[c] * error[c] * known[c];
  return quotient(std::sqrt(variance), all_known());
}

Rows length_rows(const Evidence& e, double inflation) {
  Rows rows;
  if (e.by_length()) {
    for (std::size_t layer = 0; layer < e.lengths(); ++layer)
      rows.push_back(measured_row(e, layer, inflation));
    return rows;
  }
  std::vector<Range> groups;
  for (std::size_t layer = 0; layer < e.lengths(); ++layer)
    if (energy(e.known[layer]) > 0) groups.push_back({layer, layer + 1});
  if (groups.empty()) return rows;
  for (;;) {
    rows = regressed_rows(e, groups, inflation);
    if (groups.size() == 1) return rows;
    const auto worst = std::max_element(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
      return a.all_error() < b.all_error();
    });
    if (worst->all_error() <= APART) return rows;
    merge_with_neighbour(groups, std::size_t(worst - rows.begin()));
  }
}

Rows strategy_rows(const Layered& known, const Layered& other) {
  Rows rows;
  const Image &a = known.image(), &b = other.image();
  for (std::size_t i = 0; i < a.channels.size(); ++i) {
    const std::string& name = a.channels[i];
    if (!starts_with(name, "tech.") && !starts_with(name, "merge.")) continue;
    if (name.find(".unweighted.") != std::string::npos) continue;
    const std::size_t dot = name.rfind('.');
    const std::size_t c = std::string("RGB").find(name.back());
    const int of_b = b.channel(name);
    if (c == std::string::npos || dot + 2 != name.size() || of_b < 0) continue;
    const std::string row_name = name.substr(0, dot);
    if (rows.empty() || rows.back().name != row_name) rows.push_back({row_name});
    const Total t = total_of(a, i, b, std::size_t(of_b));
    const double count = double(known.pixels());
    Row& row = rows.back();
    row.known[c] = t.known / count;
    row.other[c] = t.other / count;
    row.ratio[c] = quotient(t.other, t.known);
    row.error[c] = quotient(std::sqrt(t.variance), t.known);
  }
  return rows;
}

}  // namespace pellucid::explain

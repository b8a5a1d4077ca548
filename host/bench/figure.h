// What a benchmark tells of several runs.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pellucid {

/// One figure with its spread: median and interquartile range of the repeats.
struct Figure {
  double median = 0, iqr = 0;
};

inline Figure figure_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double q) {
    return values[std::size_t(q * double(values.size() - 1) + 0.5)];
  };
  return {at(0.5), at(0.75) - at(0.25)};
}

/// A median, and a range that holds the true one with 95 % probability whatever the distribution:
/// the order statistics beyond which a fair coin would go with less than that [Conover99 3.2]. Of
/// fewer than six values it is all of them, and holds less.
struct MedianRange {
  double median = 0, low = 0, high = 0;
};

inline MedianRange median_range(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  std::size_t out = 0;  // values left out at either end
  double tail = std::pow(0.5, double(n)), term = tail;
  while (2 * (out + 1) < n && tail <= 0.025) {
    ++out;
    term *= double(n - out + 1) / double(out);
    tail += term;
  }
  if (out > 0 && tail > 0.025) --out;
  return {figure_of(values).median, values[out], values[n - 1 - out]};
}

}  // namespace pellucid

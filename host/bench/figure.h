// What a benchmark tells of several runs.
#pragma once

#include <algorithm>
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

}  // namespace pellucid

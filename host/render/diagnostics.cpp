// Counter table, expanded from the kernels' list.
#include "render/diagnostics.h"

#include <fmt/format.h>

#include "shared/buffers.h"

namespace pellucid {

std::vector<Counter> make_counters() {
#define PELLUCID_COUNTER(name, is_error, meaning) {#name, meaning, is_error != 0, 0},
  return {DIAG_COUNTERS(PELLUCID_COUNTER)};
#undef PELLUCID_COUNTER
}

void add_counts(const std::vector<unsigned>& counts, std::vector<Counter>& counters) {
  for (std::size_t i = 0; i < counters.size(); ++i) counters[i].count += counts.at(i);
}

std::uint64_t error_count(const std::vector<Counter>& counters) {
  std::uint64_t sum = 0;
  for (const Counter& c : counters) sum += c.error ? c.count : 0;
  return sum;
}

std::string describe_counters(const std::vector<Counter>& counters) {
  std::string text;
  for (const Counter& c : counters)
    if (c.count > 0)
      text += fmt::format("{}{} {} ({})", text.empty() ? "" : "; ", c.count, c.name, c.meaning);
  return text;
}

}  // namespace pellucid

// Counters of what went wrong on the device, by name.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pellucid {

struct Counter {
  std::string name, meaning;
  bool error = false;  ///< nonzero fails a render under --strict
  std::uint64_t count = 0;
};

/// All counters at 0, in the order of DIAG_COUNTERS.
std::vector<Counter> make_counters();

/// Adds what the device counted.
void add_counts(const std::vector<unsigned>& counts, std::vector<Counter>& counters);

/// Sum of those that are errors.
std::uint64_t error_count(const std::vector<Counter>& counters);

/// "3 nonfinite (samples dropped ...); ..." of the nonzero ones, or "".
std::string describe_counters(const std::vector<Counter>& counters);

}  // namespace pellucid

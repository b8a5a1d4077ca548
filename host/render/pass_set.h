// Which global passes of a render are done: half-open ranges, in order.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pellucid {

/// Passes first, first + 1, ..., last - 1.
struct PassRange {
  std::uint64_t first = 0, last = 0;
  std::uint64_t count() const { return last - first; }
};

class PassSet {
 public:
  PassSet() = default;
  /// "0:16" or "0:16,32:48". Throws InputError for anything else.
  static PassSet parse(const std::string& text);

  /// Adds passes that are not in the set yet (else InternalError).
  void add(PassRange range);
  bool contains(PassRange range) const;
  /// Passes of both, or none.
  bool overlaps(const PassSet& other) const;
  /// What is left of `range`, in order.
  std::vector<PassRange> missing(PassRange range) const;

  std::uint64_t count() const;
  /// Passes of the set within `range`.
  std::uint64_t count(PassRange range) const;
  bool empty() const { return ranges_.empty(); }
  const std::vector<PassRange>& ranges() const { return ranges_; }
  /// "0:16,32:48", or "none".
  std::string text() const;

 private:
  std::vector<PassRange> ranges_;  ///< sorted, apart from each other
};

}  // namespace pellucid

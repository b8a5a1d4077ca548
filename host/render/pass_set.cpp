// Arithmetic of ranges.
#include "render/pass_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "base/error.h"

namespace pellucid {
namespace {

/// Reads "A:B" from the front of `rest`.
bool take_range(std::string_view& rest, PassRange& range) {
  const char* end = rest.data() + rest.size();
  const auto first = std::from_chars(rest.data(), end, range.first);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != ':') return false;
  const auto last = std::from_chars(first.ptr + 1, end, range.last);
  if (last.ec != std::errc() || range.last <= range.first) return false;
  rest.remove_prefix(std::size_t(last.ptr - rest.data()));
  return true;
}

}  // namespace

PassSet PassSet::parse(const std::string& text) {
  PassSet set;
  std::string_view rest = text;
  if (text == "none") return set;
  for (PassRange range; take_range(rest, range);) {
    if (set.count(range) > 0) break;
    set.add(range);
    if (rest.empty()) return set;
    if (rest[0] != ',') break;
    rest.remove_prefix(1);
  }
  throw InputError("'" + text + "' is no list of pass ranges such as 0:16,32:48");
}

void PassSet::add(PassRange range) {
  if (range.first == range.last) return;
  PELLUCID_CHECK(range.first < range.last && count(range) == 0, "passes are added once");
  ranges_.push_back(range);
  std::sort(ranges_.begin(), ranges_.end(),
            [](const PassRange& a, const PassRange& b) { return a.first < b.first; });
  std::vector<PassRange> joined;
  for (const PassRange& r : ranges_) {
    if (!joined.empty() && joined.back().last == r.first)
      joined.back().last = r.last;
    else
      joined.push_back(r);
  }
  ranges_ = std::move(joined);
}

bool PassSet::contains(PassRange range) const {
  return count(range) == range.count();
}

bool PassSet::overlaps(const PassSet& other) const {
  return std::any_of(other.ranges_.begin(), other.ranges_.end(),
                     [&](const PassRange& r) { return count(r) > 0; });
}

std::vector<PassRange> PassSet::missing(PassRange range) const {
  std::vector<PassRange> gaps;
  for (const PassRange& r : ranges_) {
    if (r.last <= range.first) continue;
    if (r.first >= range.last) break;
    if (r.first > range.first) gaps.push_back({range.first, r.first});
    range.first = std::min(r.last, range.last);
  }
  if (range.first < range.last) gaps.push_back(range);
  return gaps;
}

std::uint64_t PassSet::count() const {
  std::uint64_t sum = 0;
  for (const PassRange& r : ranges_) sum += r.count();
  return sum;
}

std::uint64_t PassSet::count(PassRange range) const {
  std::uint64_t sum = 0;
  for (const PassRange& r : ranges_) {
    const std::uint64_t first = std::max(r.first, range.first), last = std::min(r.last, range.last);
    if (first < last) sum += last - first;
  }
  return sum;
}

std::string PassSet::text() const {
  std::string text;
  for (const PassRange& r : ranges_)
    text += fmt::format("{}{}:{}", text.empty() ? "" : ",", r.first, r.last);
  return text.empty() ? "none" : text;
}

}  // namespace pellucid

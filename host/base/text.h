// Text for people: nearest names for typing errors, sizes and durations.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pellucid {

/// Insertions, deletions, replacements and swaps of neighbours that turn a into b.
int edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to `name`, or "" if none is near (at most a third of its letters wrong).
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// " Did you mean 'x'?" for the nearest candidate, else "": to be appended to a message.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

/// "a, b, c"
std::string join(const std::vector<std::string>& items, std::string_view separator = ", ");

std::string format_bytes(std::uint64_t bytes);  ///< "512 B", "1.5 GiB"; powers of 1024
std::string format_seconds(double seconds);     ///< "0.35 s", "12.3 s", "3m05s", "2h03m"

}  // namespace pellucid

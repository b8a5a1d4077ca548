// Who makes a study's reference.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "study/race.h"

namespace pellucid {

/// By the entries' pilots, in this order: the two quickest unbiased methods that aim at all paths;
/// an unbiased one that finds some by chance alone, if it is not much dearer than those that merge,
/// with one of these as witness; one that merges. Throws UsageError if there is none of them.
Reference choose_reference(std::vector<Entry>& entries, std::uint64_t seed, double seconds,
                           const std::function<void(const std::string&)>& tell);

}  // namespace pellucid

// A method beside itself in another precision, on the same random numbers: noise cancels, and what
// is left is what rounding costs (accuracy.md 7).
#pragma once

#include <optional>

#include "study/contender.h"

namespace pellucid {

struct PairJob {
  const Contender* strict;
  std::string precision;
};

/// Pairs of runs in turns for about `seconds`; none where that is too short for even the shortest.
std::optional<PrecisionPair> compare_precision(const StudyStage& stage, const PairJob& job,
                                               const std::vector<double>& weights,
                                               std::uint64_t seed, double seconds,
                                               const std::function<void(const std::string&)>& tell);

}  // namespace pellucid

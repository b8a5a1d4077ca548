// From runs to verdicts: time to target, flags, and a recommendation.
#pragma once

#include <cstddef>

#include "study/study.h"

namespace pellucid {

/// Most that a time to target is extrapolated over the longest run.
constexpr double EXTRAPOLATION_MOST = 32;
/// Fewest rungs that a curve is judged by.
constexpr std::size_t LEAST_RUNGS = 5;
/// Confidence of every interval in a study, two-sided.
constexpr double STUDY_CONFIDENCE = 0.9;

/// Fills in what follows from the runs: verdicts, doubts about the reference, warnings of a
/// disturbed machine, the recommendation. Pure. Throws InputError where the reference or a run that
/// was not refused holds what is no number.
void analyse(Study& study);

/// Whether it ends in a recommendation.
inline bool conclusive(const Study& study) {
  return study.recommended >= 0;
}

}  // namespace pellucid

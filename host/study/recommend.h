// Which option a study recommends, and what would change its mind.
#pragma once

#include "study/study.h"

namespace pellucid {

/// Whether it may be recommended at all: measured in full, its time to the target known, no flag.
bool eligible(const StudyOption& option, const Verdict& verdict);

/// The simplest of the options that do not differ significantly from the one with the least upper
/// bound of its time to the target; none that carries a flag. Fills in recommended, equals,
/// recommendation, would_change from the verdicts.
void recommend(Study& study);

}  // namespace pellucid

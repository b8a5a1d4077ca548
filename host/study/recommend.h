// Which option a study recommends, and what would change its mind.
#pragma once

#include "study/study.h"

namespace pellucid {

/// The simplest of the options that do not differ significantly from the one with the least upper
/// bound of its time to the target; none that carries a flag. Fills in recommended, equals,
/// recommendation, would_change from the verdicts.
void recommend(Study& study);

}  // namespace pellucid

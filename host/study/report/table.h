// The report of a study as text: a table that reads well in a terminal and on GitHub.
#pragma once

#include <string>
#include <vector>

#include "study/study.h"

namespace pellucid {

/// table.md. Pure: the same study gives the same bytes.
std::string study_table(const Study& study);

/// Up to three round numbers of seconds near which most options have rungs.
std::vector<double> round_times(const Study& study);

/// "2.0 %", with "(8.7 s)" if the nearest rung is off by more than a tenth; "-" if none is near.
std::string error_near(const StudyOption& option, double seconds);

}  // namespace pellucid

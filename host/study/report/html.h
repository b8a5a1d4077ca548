// The report of a study as one page: no script, nothing loaded from elsewhere.
#pragma once

#include <string>

#include "study/study.h"

namespace pellucid {

/// report.html; XML as well as HTML. Pure: the same study gives the same bytes.
std::string study_html(const Study& study);

}  // namespace pellucid

// The sections of the page that are not charts, each as markup; "" where there is nothing to tell.
#pragma once

#include <string>

#include "study/study.h"

namespace pellucid {

std::string option_section(const Study& study);        ///< the table of options
std::string precision_section(const Study& study);     ///< paired comparisons and their floors
std::string picture_section(const Study& study);       ///< reference, pictures, error maps
std::string reachability_section(const Study& study);  ///< what methods cannot see
std::string run_section(const Study& study);           ///< every run's raw figures

}  // namespace pellucid

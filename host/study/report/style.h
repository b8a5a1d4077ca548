// How the page looks: its style sheet, and colour and mark of every method.
#pragma once

#include <string>

#include "study/report/svg.h"
#include "study/study.h"

namespace pellucid {

/// Class of elements in a method's colour, "m-path"; "m-other" for methods not in the table.
std::string method_class(const std::string& integrator);

/// The same with "relaxed" for variants, which are drawn hollow.
std::string option_classes(const StudyOption& option);

MarkShape method_mark(const std::string& integrator);

/// CSS for screens, light and dark, and for paper.
std::string style_sheet();

}  // namespace pellucid

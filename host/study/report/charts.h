// The charts of the report, each as SVG; "" where a study has nothing to draw.
#pragma once

#include <string>

#include "study/study.h"

namespace pellucid {

/// Error over seconds, both logarithmic: bands, fits, floors, target.
std::string error_chart(const Study& study);

/// Seconds to the target with their intervals, option by option.
std::string target_chart(const Study& study);

/// Seconds of one sample per pixel, pass by pass.
std::string pass_chart(const Study& study);

/// The method with the least error times seconds in every tile of the picture.
std::string tile_chart(const Study& study);

/// Shares of variance and squared bias in the error, rung by rung: a chart for each option.
std::string split_charts(const Study& study);

}  // namespace pellucid

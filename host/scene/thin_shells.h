// Shells of glass between balls, so thin that rays which enter them start beyond their other side.
#pragma once

#include <string>

#include "scene/scene.h"

namespace pellucid {

/// What to tell the user of the first ball of glass that nearly coincides with another ball; ""
/// where there is none.
std::string thin_shell_warning(const Scene& scene);

}  // namespace pellucid

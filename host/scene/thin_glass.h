// Glass so thin that rays which enter it start beyond its other side.
#pragma once

#include <string>

#include "scene/scene.h"

namespace pellucid {

/// What to tell the user of the first pane of glass thinner than what keeps rays off surfaces; ""
/// where there is none.
std::string thin_glass_warning(const Scene& scene);

}  // namespace pellucid

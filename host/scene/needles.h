// Triangles so long and narrow that rays may pass between them.
#pragma once

#include <string>

#include "scene/scene.h"

namespace pellucid {

/// What to tell the user of the first mesh with such triangles; "" where there are none.
std::string needle_warning(const Scene& scene);

}  // namespace pellucid

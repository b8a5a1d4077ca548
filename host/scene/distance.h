// How far from the origin a scene lies, in its own sizes: positions are floats.
#pragma once

#include <string>

#include "scene/scene.h"

namespace pellucid {

/// What to tell the user of a scene so far away that rounding moves its surfaces visibly; "" of all
/// others.
std::string distance_warning(const Scene& scene);

}  // namespace pellucid

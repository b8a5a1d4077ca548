// Lights in the plane of another surface: which of the two a ray hits is then left to rounding.
#pragma once

#include <string>

#include "scene/scene.h"

namespace pellucid {

/// What to tell the user of the first light of flat faces that lies on another surface; "" where
/// none does.
std::string coplanar_warning(const Scene& scene);

}  // namespace pellucid

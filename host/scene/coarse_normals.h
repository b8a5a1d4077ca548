// Facets that stand so far off their interpolated normals that light is lost.
#pragma once

#include <string>

#include "scene/scene.h"

namespace pellucid {

/// What to tell the user of the mesh that loses most by it; "" where all lose little.
std::string coarse_normals_note(const Scene& scene);

}  // namespace pellucid

// What lies so far from where its coordinates are counted from, in its own sizes, that floats round
// it visibly.
#pragma once

#include <string>

#include "scene/mesh_tools.h"
#include "scene/scene.h"

namespace pellucid {

/// What to tell the user of the shape that the scene's coordinates round most; "" where that does
/// not matter. In a scene that was loaded, this is left where things lie far from each other.
std::string distance_warning(const Scene& scene);

/// The same of a mesh as it comes from its file: one that is written in floats far from its origin
/// was rounded before it came here.
std::string rounded_file_warning(const std::string& name, const RawMesh& mesh);

}  // namespace pellucid

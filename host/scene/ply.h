// PLY models: ASCII and binary, polygons as triangles.
#pragma once

#include <string>

#include "scene/model.h"

namespace pellucid {

/// One part without a name or material. Throws InputError with file and line (ASCII) or byte
/// (binary) for anything that is missing, malformed or out of range.
Model load_ply(const std::string& path, const ModelOptions& options);

}  // namespace pellucid

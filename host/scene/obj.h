// OBJ models with their MTL materials, in terms of the scene model.
#pragma once

#include <string>

#include "scene/model.h"

namespace pellucid {

/// Throws InputError with file and line for anything that is missing, malformed or out of range.
Model load_obj(const std::string& path, const ModelOptions& options);

}  // namespace pellucid

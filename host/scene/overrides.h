// Changes to a scene file from the command line, before it is parsed.
#pragma once

#include <string>

#include "scene/json_tree.h"

namespace pellucid {

/// Sets one value: `camera.fov=30`, `shapes[0].material=red`, `/film/width=64`. What is left of the
/// first '=' is a dotted path or a JSON pointer; missing objects are made, and the index after the
/// last item (or "-") adds an item. What is right of it is JSON, else a text. Errors that the value
/// causes later name the option. Throws UsageError for a text of another form, InputError for a
/// path that the document has no place for.
void apply_override(JsonNode& root, const std::string& definition);

}  // namespace pellucid

// The scene format as a JSON schema, for editors and other programs.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace pellucid {

/// JSON Schema, draft 2020-12, made from the tables that the parser uses (schema.h). What it says
/// is what the parser checks key by key; relations between keys ("this or that") are the parser's.
nlohmann::ordered_json scene_json_schema();

}  // namespace pellucid

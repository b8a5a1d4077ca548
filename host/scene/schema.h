// The native scene format as tables: what the parser checks and what a JSON schema is written from.
#pragma once

#include <string>
#include <vector>

namespace pellucid {

enum class FieldType {
  boolean,
  integer,
  number,
  text,    ///< not empty
  choice,  ///< one of Field::choices
  vector,  ///< three numbers
  scale,   ///< three numbers or one for all
  pair,    ///< two numbers
  color,   ///< [r,g,b] linear Rec.709, one number (grey), or {"srgb": [r,g,b]}
  matrix,  ///< 16 numbers, row by row, for column vectors
  edges,   ///< two vectors
  names,   ///< two texts
  object,  ///< of the kind Field::of
  map,     ///< an object whose keys are names, and whose values are of the kind Field::of
  array,   ///< a list of objects of the kind Field::of
};

/// Closed unless `open_low`. Numbers are always finite.
struct Range {
  double low = 0.0, high = 0.0;
  bool open_low = false;
};

/// One key of an object.
struct Field {
  const char* key;
  FieldType type;
  const char* fallback;  ///< the default as JSON text; `required` or `optional` where there is none
  Range range;           ///< of every number in the value; unused for other types
  const char* doc;       ///< unit and meaning
  std::vector<std::string> choices = {};
  const char* of = "";  ///< an ObjectSpec, or with a '/' at its end a family, as in "light/"
};
inline constexpr const char* required = nullptr;
inline constexpr const char* optional = "";

/// One kind of object; kinds that `"type"` picks between are called family/type.
struct ObjectSpec {
  std::string name;
  const char* doc;
  std::vector<Field> fields;
};

/// All kinds of objects there are.
const std::vector<ObjectSpec>& object_specs();

/// The kind of that name; InternalError if there is none.
const ObjectSpec& object_spec(const std::string& name);

/// The types of a family, such as diffuse, mirror, ... of "material".
std::vector<std::string> family_types(const std::string& family);

}  // namespace pellucid

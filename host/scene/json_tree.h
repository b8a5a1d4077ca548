// JSON text to a tree whose nodes know where they stand, so that every later error can point there.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace pellucid {

/// A text being parsed; nodes keep it alive for their error messages.
struct JsonSource {
  std::string path;
  std::string text;
  bool has_lines = true;  ///< false: an option or the like; messages show no line of it
  std::string hint = {};  ///< ends messages that have no "Did you mean" of their own
};

struct JsonMember;

/// One JSON value. `text` holds a string's value, `number` a number's.
struct JsonNode {
  enum class Kind { null, boolean, number, string, array, object };

  Kind kind = Kind::null;
  bool boolean = false;
  bool is_integer = false;  ///< the number was written without fraction or exponent
  double number = 0.0;
  std::string text;
  std::vector<JsonNode> items;      ///< of an array
  std::vector<JsonMember> members;  ///< of an object, in the order of the file; keys are unique
  std::string path;                 ///< from the root, such as shapes[3].radius; "" is the root
  std::size_t offset = 0;           ///< byte of `source->text` where the value starts
  std::shared_ptr<const JsonSource> source;

  const JsonNode* find(const std::string& key) const;
};

struct JsonMember {
  std::string key;
  std::size_t key_offset = 0;
  JsonNode value;
};

/// "a number", "an object", ... as messages say it.
const char* kind_name(JsonNode::Kind kind);

/// Parses a whole document; comments (// and /* */) are allowed, duplicated keys are errors.
JsonNode parse_json(const std::string& path, std::string text);
JsonNode parse_json(std::shared_ptr<const JsonSource> source);

/// Path of a member or an item of `parent`, as messages say it.
std::string member_path(const JsonNode& parent, const std::string& key);
std::string item_path(const JsonNode& parent, std::size_t index);

/// Throws InputError: `path:line:col: json.path: why`, then the line and a caret under the place;
/// `path: json.path: why` where the source has no lines.
[[noreturn]] void fail_at(const JsonSource& source, std::size_t offset,
                          const std::string& json_path, const std::string& why);
[[noreturn]] void fail(const JsonNode& node, const std::string& why);

}  // namespace pellucid

// Reads one JSON object by its table: checks everything first, then hands out typed values.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "scene/json_tree.h"
#include "scene/scene.h"
#include "scene/schema.h"

namespace pellucid {

class ObjectReader {
 public:
  /// Throws InputError unless the node is an object whose keys are known, complete, of the right
  /// type and in range. Both arguments must outlive the reader.
  ObjectReader(const JsonNode& node, const ObjectSpec& spec);

  /// Whether the file gives the key; defaults do not count.
  bool has(const std::string& key) const { return node_.find(key) != nullptr; }
  /// The only one of `keys` that is given; none or several are an error.
  std::string exactly_one(std::initializer_list<const char*> keys) const;

  // The file's value, or the table's default. Optional keys need has() first.
  bool boolean(const std::string& key) const;
  int integer(const std::string& key) const;
  double number(const std::string& key) const;
  std::string text(const std::string& key) const;
  glm::dvec2 pair(const std::string& key) const;
  glm::dvec3 vector(const std::string& key) const;  ///< also of type scale
  Rgb color(const std::string& key) const;
  std::vector<double> numbers(const std::string& key) const;
  JsonNode value(const std::string& key) const;

  const JsonNode& node() const { return node_; }
  /// The node of a key, for messages; the object itself where the key is absent.
  const JsonNode& place(const std::string& key) const;

 private:
  const Field& field(const std::string& key) const;

  const JsonNode& node_;
  const ObjectSpec& spec_;
};

/// The table of `family` that the object's "type" picks.
const ObjectSpec& typed_spec(const JsonNode& node, const std::string& family);

/// A text that is not empty.
const std::string& read_text(const JsonNode& node);

/// A list of three numbers in range.
glm::dvec3 read_vector(const JsonNode& node, const Range& range);

}  // namespace pellucid

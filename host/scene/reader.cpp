// Reads one JSON object by its table.
#include "scene/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "scene/text_file.h"

namespace pellucid {
namespace {

using Kind = JsonNode::Kind;

void expect_kind(const JsonNode& node, Kind kind, const char* wanted) {
  if (node.kind != kind)
    fail(node, fmt::format("{} is needed here, not {}", wanted, kind_name(node.kind)));
}

void check_number(const JsonNode& node, const Range& range) {
  expect_kind(node, Kind::number, "a number");
  const bool low_ok = range.open_low ? node.number > range.low : node.number >= range.low;
  if (!std::isfinite(node.number) || !low_ok || node.number > range.high)
    fail(node,
         fmt::format("{:g} is out of range; it must be {} {:g} and at most {:.10g}", node.number,
                     range.open_low ? "greater than" : "at least", range.low, range.high));
}

void check_numbers(const JsonNode& node, std::size_t count, const Range& range) {
  if (node.kind != Kind::array || node.items.size() != count)
    fail(node, fmt::format("a list of {} numbers is needed here, not {}", count,
                           node.kind == Kind::array ? fmt::format("a list of {}", node.items.size())
                                                    : kind_name(node.kind)));
  for (const JsonNode& item : node.items) check_number(item, range);
}

/// The sRGB curve (IEC 61966-2-1), from display value to linear.
double srgb_to_linear(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

Rgb to_color(const JsonNode& node) {
  if (node.kind == Kind::number) return Rgb(node.number);
  const bool encoded = node.kind == Kind::object;
  const std::vector<JsonNode>& c = encoded ? node.members[0].value.items : node.items;
  Rgb color(c[0].number, c[1].number, c[2].number);
  if (encoded)
    for (int i = 0; i < 3; ++i) color[i] = srgb_to_linear(color[i]);
  return color;
}

void check_color(const JsonNode& node, const Range& range) {
  if (node.kind == Kind::object) {
    if (node.members.size() != 1 || node.members[0].key != "srgb")
      fail(node, "a colour object has the one key \"srgb\"");
    check_numbers(node.members[0].value, 3, {0.0, 1.0});
    const Rgb color = to_color(node);
    if (glm::any(glm::lessThan(color, Rgb(range.low))) ||
        glm::any(glm::greaterThan(color, Rgb(range.high))))
      fail(node, fmt::format("must be at least {:g} and at most {:g} in linear light", range.low,
                             range.high));
  } else if (node.kind == Kind::array) {
    check_numbers(node, 3, range);
  } else if (node.kind == Kind::number) {
    check_number(node, range);
  } else {
    fail(node, fmt::format("a colour is needed here: [r, g, b], a number (grey) or "
                           "{{\"srgb\": [r, g, b]}}, not {}",
                           kind_name(node.kind)));
  }
}

void check_text(const JsonNode& node, const Field& field) {
  read_text(node);
  if (field.type != FieldType::choice) return;
  if (std::find(field.choices.begin(), field.choices.end(), node.text) == field.choices.end())
    fail(node, fmt::format("\"{}\" is not known here.{} Valid: {}", printable(node.text),
                           did_you_mean(printable(node.text), field.choices),
                           list_choices(field.choices)));
}

void check_integer(const JsonNode& node, const Range& range) {
  check_number(node, range);
  if (node.number != std::floor(node.number)) fail(node, "a whole number is needed here");
}

void check_edges(const JsonNode& node, const Range& range) {
  if (node.kind != Kind::array || node.items.size() != 2)
    fail(node, "two edges are needed: [[x, y, z], [x, y, z]]");
  for (const JsonNode& edge : node.items) check_numbers(edge, 3, range);
}

void check_value(const JsonNode& node, const Field& field) {
  switch (field.type) {
    case FieldType::boolean:
      return expect_kind(node, Kind::boolean, "true or false");
    case FieldType::integer:
      return check_integer(node, field.range);
    case FieldType::number:
      return check_number(node, field.range);
    case FieldType::text:
    case FieldType::choice:
      return check_text(node, field);
    case FieldType::vector:
      return check_numbers(node, 3, field.range);
    case FieldType::scale:
      return node.kind == Kind::number ? check_number(node, field.range)
                                       : check_numbers(node, 3, field.range);
    case FieldType::pair:
      return check_numbers(node, 2, field.range);
    case FieldType::color:
      return check_color(node, field.range);
    case FieldType::matrix:
      return check_numbers(node, 16, field.range);
    case FieldType::edges:
      return check_edges(node, field.range);
    case FieldType::object:
    case FieldType::map:
      return expect_kind(node, Kind::object, "an object");
    case FieldType::names:
    case FieldType::array:
      return expect_kind(node, Kind::array, "a list");
  }
}

std::vector<std::string> keys_of(const ObjectSpec& spec) {
  std::vector<std::string> keys;
  for (const Field& field : spec.fields) keys.emplace_back(field.key);
  return keys;
}

}  // namespace

ObjectReader::ObjectReader(const JsonNode& node, const ObjectSpec& spec)
    : node_(node), spec_(spec) {
  expect_kind(node, Kind::object, "an object");
  const std::vector<std::string> keys = keys_of(spec);
  for (const JsonMember& member : node.members) {
    const auto found = std::find(keys.begin(), keys.end(), member.key);
    if (found == keys.end())
      fail_at(*member.value.source, member.key_offset, node.path,
              fmt::format("unknown key \"{}\" in {}.{} Valid: {}", printable(member.key), spec.name,
                          did_you_mean(printable(member.key), keys), list_choices(keys)));
    check_value(member.value, spec.fields[static_cast<std::size_t>(found - keys.begin())]);
  }
  for (const Field& field : spec.fields)
    if (field.fallback == required && !has(field.key))
      fail(node, fmt::format("{} needs the key \"{}\" ({})", spec.name, field.key, field.doc));
}

const Field& ObjectReader::field(const std::string& key) const {
  for (const Field& candidate : spec_.fields)
    if (key == candidate.key) return candidate;
  throw InternalError(fmt::format("the table of {} has no key {}", spec_.name, key));
}

JsonNode ObjectReader::value(const std::string& key) const {
  if (const JsonNode* given = node_.find(key)) return *given;
  const Field& wanted = field(key);
  PELLUCID_CHECK(wanted.fallback != required && *wanted.fallback != '\0',
                 "an optional key was read without asking has()");
  JsonNode node = parse_json("the default of " + spec_.name + "." + key, wanted.fallback);
  check_value(node, wanted);
  return node;
}

const JsonNode& ObjectReader::place(const std::string& key) const {
  const JsonNode* given = node_.find(key);
  return given != nullptr ? *given : node_;
}

std::string ObjectReader::exactly_one(std::initializer_list<const char*> keys) const {
  std::string found;
  for (const char* key : keys) {
    if (!has(key)) continue;
    if (!found.empty()) fail(*node_.find(key), fmt::format("give \"{}\" or this, not both", found));
    found = key;
  }
  if (found.empty())
    fail(node_, fmt::format("{} needs one of the keys {}", spec_.name,
                            list_choices({keys.begin(), keys.end()})));
  return found;
}

bool ObjectReader::boolean(const std::string& key) const {
  return value(key).boolean;
}
int ObjectReader::integer(const std::string& key) const {
  return static_cast<int>(value(key).number);
}
double ObjectReader::number(const std::string& key) const {
  return value(key).number;
}
std::string ObjectReader::text(const std::string& key) const {
  return value(key).text;
}
Rgb ObjectReader::color(const std::string& key) const {
  return to_color(value(key));
}

std::vector<double> ObjectReader::numbers(const std::string& key) const {
  const JsonNode node = value(key);
  std::vector<double> result;
  for (const JsonNode& item : node.items) result.push_back(item.number);
  if (node.kind == Kind::number) result.assign(3, node.number);  // a scale alike on all axes
  return result;
}

glm::dvec2 ObjectReader::pair(const std::string& key) const {
  const std::vector<double> v = numbers(key);
  return {v[0], v[1]};
}

glm::dvec3 ObjectReader::vector(const std::string& key) const {
  const std::vector<double> v = numbers(key);
  return {v[0], v[1], v[2]};
}

const ObjectSpec& typed_spec(const JsonNode& node, const std::string& family) {
  expect_kind(node, Kind::object, "an object");
  const std::vector<std::string> types = family_types(family);
  const JsonNode* type = node.find("type");
  if (type == nullptr)
    fail(node, fmt::format("a {} needs the key \"type\": {}", family, list_choices(types)));
  expect_kind(*type, Kind::string, "a text");
  if (std::find(types.begin(), types.end(), type->text) == types.end())
    fail(*type,
         fmt::format("there is no {} of type \"{}\".{} Valid: {}", family, printable(type->text),
                     did_you_mean(printable(type->text), types), list_choices(types)));
  return object_spec(family + "/" + type->text);
}

const std::string& read_text(const JsonNode& node) {
  expect_kind(node, Kind::string, "a text");
  if (node.text.empty()) fail(node, "must not be empty");
  // Names of files and kernels would end there.
  if (node.text.find('\0') != std::string::npos) fail(node, "must not hold a zero character");
  return node.text;
}

glm::dvec3 read_vector(const JsonNode& node, const Range& range) {
  check_numbers(node, 3, range);
  return {node.items[0].number, node.items[1].number, node.items[2].number};
}

}  // namespace pellucid

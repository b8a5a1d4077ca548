// The scene format as a JSON schema: a definition per kind of object, a rule per type of field.
#include "scene/json_schema.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "scene/schema.h"

namespace pellucid {
namespace {

using Json = nlohmann::ordered_json;

Json number(const Range& range, const char* type = "number") {
  constexpr double unlimited = 1e30;  // what the tables write where any number will do
  Json rule = {{"type", type}};
  if (range.low > -unlimited) rule[range.open_low ? "exclusiveMinimum" : "minimum"] = range.low;
  if (range.high < unlimited) rule["maximum"] = range.high;
  return rule;
}

Json list_of(const Json& item, int count) {
  return {{"type", "array"}, {"items", item}, {"minItems", count}, {"maxItems", count}};
}

Json closed_object(Json properties, Json required_keys) {
  return {{"type", "object"},
          {"properties", std::move(properties)},
          {"required", std::move(required_keys)},
          {"additionalProperties", false}};
}

Json color(const Range& range) {
  const Json srgb = closed_object({{"srgb", list_of(number({0.0, 1.0}), 3)}}, {"srgb"});
  return {{"anyOf", {number(range), list_of(number(range), 3), srgb}}};
}

std::string definition_name(std::string name) {
  for (char& c : name)
    if (c == '/' || c == ' ') c = '-';
  if (name.back() == '-') name.pop_back();  // a family
  return name;
}

Json reference(const Field& field) {
  PELLUCID_CHECK(*field.of != '\0', std::string("the table does not say what is in ") + field.key);
  return {{"$ref", "#/$defs/" + definition_name(field.of)}};
}

Json value_rule(const Field& field) {
  switch (field.type) {
    case FieldType::boolean:
      return {{"type", "boolean"}};
    case FieldType::integer:
      return number(field.range, "integer");
    case FieldType::number:
      return number(field.range);
    case FieldType::text:
      return {{"type", "string"}, {"minLength", 1}};
    case FieldType::choice:
      return {{"enum", field.choices}};
    case FieldType::vector:
      return list_of(number(field.range), 3);
    case FieldType::scale:
      return {{"anyOf", {number(field.range), list_of(number(field.range), 3)}}};
    case FieldType::pair:
      return list_of(number(field.range), 2);
    case FieldType::color:
      return color(field.range);
    case FieldType::matrix:
      return list_of(number(field.range), 16);
    case FieldType::edges:
      return list_of(list_of(number(field.range), 3), 2);
    case FieldType::names:
      return list_of({{"type", "string"}, {"minLength", 1}}, 2);
    case FieldType::object:
      return reference(field);
    case FieldType::map:
      return {{"type", "object"},
              {"propertyNames", {{"minLength", 1}}},
              {"additionalProperties", reference(field)}};
    case FieldType::array:
      return {{"type", "array"}, {"items", reference(field)}};
  }
  throw InternalError("unknown type of field");
}

Json object_rule(const ObjectSpec& spec) {
  Json properties = Json::object(), needed = Json::array();
  const std::size_t slash = spec.name.find('/');
  for (const Field& field : spec.fields) {
    Json rule = value_rule(field);
    if (slash != std::string::npos && std::string(field.key) == "type")
      rule = {{"const", spec.name.substr(slash + 1)}};
    rule["description"] = field.doc;
    if (field.fallback == required) {
      needed.push_back(field.key);
    } else if (*field.fallback != '\0') {
      rule["default"] = Json::parse(field.fallback);
    }
    properties[field.key] = std::move(rule);
  }
  Json object = closed_object(std::move(properties), std::move(needed));
  object["description"] = spec.doc;
  return object;
}

/// "type" decides which kind it is; editors then complain about that kind alone.
Json family_rule(const std::string& family) {
  Json rule = {{"type", "object"},
               {"required", {"type"}},
               {"properties", {{"type", {{"enum", family_types(family)}}}}}};
  for (const std::string& type : family_types(family)) {
    const Json chosen = {{"properties", {{"type", {{"const", type}}}}}};
    const Json kind = {{"$ref", "#/$defs/" + definition_name(family + "/" + type)}};
    rule["allOf"].push_back({{"if", chosen}, {"then", kind}});
  }
  return rule;
}

}  // namespace

nlohmann::ordered_json scene_json_schema() {
  Json definitions = Json::object();
  for (const ObjectSpec& spec : object_specs()) {
    const std::size_t slash = spec.name.find('/');
    if (slash != std::string::npos && !definitions.contains(spec.name.substr(0, slash)))
      definitions[spec.name.substr(0, slash)] = family_rule(spec.name.substr(0, slash));
    definitions[definition_name(spec.name)] = object_rule(spec);
  }
  return {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
          {"title", "pellucid scene"},
          {"$ref", "#/$defs/scene"},
          {"$defs", std::move(definitions)}};
}

}  // namespace pellucid

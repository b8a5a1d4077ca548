// Overrides: path to tokens, tokens to a place in the tree, text to a value.
#include "scene/overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "base/error.h"
#include "base/text.h"
#include "scene/text_file.h"

namespace pellucid {
namespace {

using Kind = JsonNode::Kind;
using Tokens = std::vector<std::string>;

constexpr std::size_t most_tokens = 16;  // deeper than any key of a scene
constexpr const char* append_token = "-";

[[noreturn]] void refuse(const std::string& definition, const char* why) {
  throw UsageError(
      fmt::format("-D '{}': {}; it takes json.pointer=value such as camera.fov=30 or "
                  "/film/width=64",
                  printable(definition), why));
}

/// RFC 6901: ~1 is a slash, ~0 a tilde.
std::string unescaped(const std::string& token, const std::string& definition) {
  std::string text;
  for (std::size_t i = 0; i < token.size(); ++i) {
    if (token[i] != '~') {
      text += token[i];
      continue;
    }
    const char next = i + 1 < token.size() ? token[++i] : '\0';
    if (next != '0' && next != '1') refuse(definition, "in a pointer ~ is written ~0, and / ~1");
    text += next == '0' ? '~' : '/';
  }
  return text;
}

Tokens split_path(std::string path, const std::string& definition) {
  const bool pointer = path[0] == '/';
  if (pointer) {
    path.erase(0, 1);
  } else {  // shapes[3].radius, as messages have it
    path.erase(std::remove(path.begin(), path.end(), ']'), path.end());
    std::replace(path.begin(), path.end(), '[', '.');
  }
  Tokens tokens;
  for (std::size_t start = 0; start <= path.size();) {
    const std::size_t end = std::min(path.find(pointer ? '/' : '.', start), path.size());
    const std::string token = path.substr(start, end - start);
    if (token.empty()) refuse(definition, "a part of the path is empty");
    tokens.push_back(pointer ? unescaped(token, definition) : token);
    start = end + 1;
  }
  if (tokens.size() > most_tokens) refuse(definition, "the path is too deep");
  return tokens;
}

void prefix_paths(JsonNode& node, const std::string& prefix) {
  const bool joins = node.path.empty() || node.path[0] == '[';
  node.path = prefix + (joins ? "" : ".") + node.path;
  for (JsonNode& item : node.items) prefix_paths(item, prefix);
  for (JsonMember& member : node.members) prefix_paths(member.value, prefix);
}

/// What starts like JSON has to be JSON; anything else that is none is a text.
JsonNode parse_value(const std::shared_ptr<const JsonSource>& source) {
  try {
    return parse_json(source);
  } catch (const InputError&) {
    if (!source->text.empty() && std::string("{[\"").find(source->text[0]) != std::string::npos)
      throw;
  }
  JsonNode node;
  node.kind = Kind::string;
  node.text = source->text;
  node.source = source;
  return node;
}

/// A walk from the root to the place that the option means.
class Walk {
 public:
  Walk(JsonNode& root, std::shared_ptr<JsonSource> source)
      : node_(&root), source_(std::move(source)) {}

  void step(const std::string& token) {
    if (node_->kind == Kind::array) return step_into_list(token);
    if (node_->kind != Kind::object) {
      fail_at(*source_, 0, node_->path,
              fmt::format("this is {}, so that nothing in it can be called \"{}\"",
                          kind_name(node_->kind), printable(token)));
    }
    for (JsonMember& member : node_->members)
      if (member.key == token) return void(node_ = &member.value);
    suggest(token);
    JsonNode made = make(member_path(*node_, token));
    node_->members.push_back({token, 0, std::move(made)});
    node_ = &node_->members.back().value;
  }

  /// Whether the next step, to `token`, needs an object or a list where there is nothing yet.
  void prepare(const std::string& token) {
    if (node_->kind != Kind::null || node_->source != source_) return;
    node_->kind = token == "0" || token == append_token ? Kind::array : Kind::object;
  }

  JsonNode& place() { return *node_; }

 private:
  void step_into_list(const std::string& token) {
    const std::size_t size = node_->items.size();
    std::size_t index = 0;
    const char* const end = token.data() + token.size();
    const auto [stop, error] = std::from_chars(token.data(), end, index);
    const bool number = error == std::errc() && stop == end;
    if (token == append_token) index = size;
    if ((!number && token != append_token) || index > size)
      fail_at(*source_, 0, node_->path,
              fmt::format("the list of {} here has no item \"{}\"; {} or {} adds one", size,
                          printable(token), size, append_token));
    if (index == size) node_->items.push_back(make(item_path(*node_, size)));
    node_ = &node_->items[index];
  }

  JsonNode make(std::string path) const {
    JsonNode node;
    node.path = std::move(path);
    node.source = source_;
    return node;
  }

  void suggest(const std::string& token) {
    std::vector<std::string> names;
    for (const JsonMember& member : node_->members) names.push_back(printable(member.key));
    if (source_->hint.empty()) source_->hint = did_you_mean(printable(token), names);
  }

  JsonNode* node_;
  std::shared_ptr<JsonSource> source_;
};

}  // namespace

void apply_override(JsonNode& root, const std::string& definition) {
  const std::size_t equals = definition.find('=');
  if (equals == std::string::npos) refuse(definition, "there is no '='");
  if (equals == 0) refuse(definition, "there is no path before '='");
  auto source = std::make_shared<JsonSource>(
      JsonSource{"-D " + printable(definition, 100), definition.substr(equals + 1), false});
  if (root.kind != Kind::object) return;  // the parser says so, with its place in the file
  JsonNode value = parse_value(source);
  Walk walk(root, source);
  for (const std::string& token : split_path(definition.substr(0, equals), definition)) {
    walk.prepare(token);
    walk.step(token);
  }
  prefix_paths(value, walk.place().path);
  walk.place() = std::move(value);
}

}  // namespace pellucid

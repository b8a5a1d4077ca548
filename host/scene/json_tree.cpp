// JSON text to a tree with positions: nlohmann's SAX events say what comes next, and a cursor that
// walks the same text token by token says where it stood.
#include "scene/json_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <unordered_set>

#include "base/error.h"
#include "scene/text_file.h"

namespace pellucid {
namespace {

/// Deeper nesting than any scene has; keeps recursion over the tree away from the stack's end.
constexpr std::size_t max_depth = 32;
/// More values than any scene has, and few enough to hold: geometry belongs into models.
constexpr std::size_t max_values = std::size_t{2} << 20;

/// Steps over the tokens of text that the parser has already accepted.
class TokenCursor {
 public:
  explicit TokenCursor(const std::string& text) : text_(text) {}

  /// Passes one token, which may be a separator-led value, key or bracket; returns its start.
  std::size_t take() {
    skip_separators();
    const std::size_t start = at_;
    if (at_ >= text_.size()) return start;
    if (text_[at_] == '"') {
      for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_)
        if (text_[at_] == '\\') ++at_;
      ++at_;
    } else if (std::strchr("{}[]", text_[at_]) != nullptr) {
      ++at_;
    } else {
      at_ = std::min(text_.find_first_of(" \t\r\n,:/{}[]\"", at_), text_.size());
    }
    return start;
  }

 private:
  void skip_separators() {
    while (at_ < text_.size()) {
      if (std::strchr(" \t\r\n,:", text_[at_]) != nullptr && text_[at_] != '\0') {
        ++at_;
      } else if (text_.compare(at_, 2, "//") == 0) {
        at_ = std::min(text_.find_first_of("\r\n", at_), text_.size());
      } else if (text_.compare(at_, 2, "/*") == 0) {
        const std::size_t end = text_.find("*/", at_ + 2);
        at_ = end == std::string::npos ? text_.size() : end + 2;
      } else {
        return;
      }
    }
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

/// Receives the parser's events and builds the tree.
class TreeBuilder : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit TreeBuilder(std::shared_ptr<const JsonSource> source)
      : source_(std::move(source)), cursor_(source_->text) {}

  JsonNode take_root() { return std::move(root_); }

  bool null() override { return add(JsonNode::Kind::null), true; }
  bool boolean(bool value) override {
    add(JsonNode::Kind::boolean).boolean = value;
    return true;
  }
  bool number_integer(number_integer_t value) override {
    return add_number(static_cast<double>(value), true);
  }
  bool number_unsigned(number_unsigned_t value) override {
    return add_number(static_cast<double>(value), true);
  }
  bool number_float(number_float_t value, const string_t&) override {
    return add_number(value, false);
  }
  bool string(string_t& value) override {
    add(JsonNode::Kind::string).text = value;
    return true;
  }
  bool binary(binary_t&) override { return false; }  // never in text
  bool start_object(std::size_t) override { return open(JsonNode::Kind::object); }
  bool start_array(std::size_t) override { return open(JsonNode::Kind::array); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    const std::size_t offset = cursor_.take();
    JsonNode& object = *open_.back();
    if (!keys_.back().insert(name).second)
      fail_at(*source_, offset, object.path,
              fmt::format("key \"{}\" is given twice", printable(name)));
    object.members.push_back({name, offset, {}});
    return true;
  }

  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception& error) override {
    std::string why = error.what();
    const std::size_t colon = why.find("syntax error");
    if (colon != std::string::npos) {
      why = why.substr(colon);
    } else {
      why = why.substr(std::min(why.find("] ") + 2, why.size()));
    }
    constexpr std::size_t longest_reason = 500;  // it may quote the rest of the file
    const std::size_t offset = position > 0 ? position - 1 : 0;
    fail_at(*source_, std::min(offset, source_->text.size()), "",
            "not valid JSON: " + printable(why, longest_reason));
  }

 private:
  JsonNode& add(JsonNode::Kind kind) {
    JsonNode* node = &root_;
    if (++values_ > max_values)
      fail_at(*source_, cursor_.take(), open_.back()->path,
              fmt::format("more than {} values; large geometry belongs into a \"mesh\" file",
                          max_values));
    if (!open_.empty()) {
      JsonNode& parent = *open_.back();
      if (parent.kind == JsonNode::Kind::array) {
        parent.items.emplace_back();
        node = &parent.items.back();
        node->path = item_path(parent, parent.items.size() - 1);
      } else {
        node = &parent.members.back().value;
        node->path = member_path(parent, parent.members.back().key);
      }
    }
    node->kind = kind;
    node->offset = cursor_.take();
    node->source = source_;
    return *node;
  }

  bool add_number(double value, bool is_integer) {
    JsonNode& node = add(JsonNode::Kind::number);
    node.number = value;
    node.is_integer = is_integer;
    return true;
  }

  bool open(JsonNode::Kind kind) {
    JsonNode& node = add(kind);
    if (open_.size() >= max_depth)
      fail(node, fmt::format("nested deeper than {} levels", max_depth));
    // Pointers stay valid: a parent's list grows only after this node has been closed.
    open_.push_back(&node);
    keys_.emplace_back();
    return true;
  }

  bool close() {
    cursor_.take();
    open_.pop_back();
    keys_.pop_back();
    return true;
  }

  std::shared_ptr<const JsonSource> source_;
  TokenCursor cursor_;
  JsonNode root_;
  std::vector<JsonNode*> open_;
  std::vector<std::unordered_set<std::string>> keys_;  ///< of each open node
  std::size_t values_ = 0;
};

}  // namespace

const JsonNode* JsonNode::find(const std::string& key) const {
  for (const JsonMember& member : members)
    if (member.key == key) return &member.value;
  return nullptr;
}

const char* kind_name(JsonNode::Kind kind) {
  switch (kind) {
    case JsonNode::Kind::null:
      return "null";
    case JsonNode::Kind::boolean:
      return "true or false";
    case JsonNode::Kind::number:
      return "a number";
    case JsonNode::Kind::string:
      return "a text";
    case JsonNode::Kind::array:
      return "a list";
    case JsonNode::Kind::object:
      return "an object";
  }
  return "a value";
}

std::string member_path(const JsonNode& parent, const std::string& key) {
  return parent.path.empty() ? printable(key) : parent.path + "." + printable(key);
}

std::string item_path(const JsonNode& parent, std::size_t index) {
  return fmt::format("{}[{}]", parent.path, index);
}

JsonNode parse_json(const std::string& path, std::string text) {
  return parse_json(std::make_shared<const JsonSource>(JsonSource{path, std::move(text)}));
}

JsonNode parse_json(std::shared_ptr<const JsonSource> source) {
  // The parser would take it for the end of the text.
  const std::size_t zero = source->text.find('\0');
  if (zero != std::string::npos) fail_at(*source, zero, "", "a zero byte: this is no JSON text");
  TreeBuilder builder(source);
  constexpr bool strict = true, ignore_comments = true;
  nlohmann::json::sax_parse(source->text.begin(), source->text.end(), &builder,
                            nlohmann::json::input_format_t::json, strict, ignore_comments);
  return builder.take_root();
}

void fail_at(const JsonSource& source, std::size_t offset, const std::string& json_path,
             const std::string& why) {
  if (!source.has_lines) {
    const bool hints = why.find("Did you mean") != std::string::npos;
    throw InputError(fmt::format("{}: {}{}{}{}", source.path, json_path,
                                 json_path.empty() ? "" : ": ", why, hints ? "" : source.hint));
  }
  const std::string& text = source.text;
  offset = std::min(offset, text.size());
  const std::size_t newline = offset == 0 ? std::string::npos : text.rfind('\n', offset - 1);
  const std::size_t start = newline == std::string::npos ? 0 : newline + 1;
  const std::size_t end = std::min(text.find('\n', offset), text.size());
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(start), '\n');

  // Long lines are shown as a window around the place.
  constexpr std::size_t window = 90, lead = 60;
  const std::size_t from = offset - start > lead ? offset - lead : start;
  const std::string excerpt = printable(text.substr(from, std::min(end - from, window)), window);
  const std::string number = fmt::format("{:>5}", line);
  throw InputError(fmt::format("{}:{}:{}: {}{}{}\n{} | {}\n{} | {}^", source.path, line,
                               offset - start + 1, json_path, json_path.empty() ? "" : ": ", why,
                               number, excerpt, std::string(number.size(), ' '),
                               std::string(offset - from, ' ')));
}

void fail(const JsonNode& node, const std::string& why) {
  fail_at(*node.source, node.offset, node.path, why);
}

}  // namespace pellucid

// Ways to spoil a text file.
#include "support/bad_text.h"

#include <algorithm>
#include <cctype>

#include "support/test_scenes.h"

namespace pellucid::test {
namespace {

std::size_t end_of_string(const std::string& text, std::size_t quote) {
  std::size_t at = quote + 1;
  while (text[at] != '"') at += text[at] == '\\' ? 2 : 1;
  return at + 1;
}

std::string with_random_changes(const std::string& text, Random& random) {
  std::string changed = text;
  for (unsigned n = 1 + random.below(4); n > 0 && !changed.empty(); --n) {
    const std::size_t at = random.below(static_cast<unsigned>(changed.size()));
    const unsigned kind = random.below(4);
    // Bytes from the text itself keep the damage near the grammar.
    const char own = text[random.below(static_cast<unsigned>(text.size()))];
    if (kind == 0) changed[at] = static_cast<char>(random.below(256));
    if (kind == 1) changed[at] = own;
    if (kind == 2) changed.erase(at, 1 + random.below(8));
    if (kind == 3) changed.insert(at, changed, random.below(unsigned(changed.size())), 4);
  }
  return changed;
}

}  // namespace

Span span_of(const JsonNode& node) {
  const std::string& text = node.source->text;
  if (node.kind == JsonNode::Kind::string) return {node.offset, end_of_string(text, node.offset)};
  if (node.kind == JsonNode::Kind::array) {
    const std::size_t last = node.items.empty() ? node.offset + 1 : span_of(node.items.back()).end;
    return {node.offset, text.find(']', last) + 1};
  }
  if (node.kind == JsonNode::Kind::object) {
    const std::size_t last =
        node.members.empty() ? node.offset + 1 : span_of(node.members.back().value).end;
    return {node.offset, text.find('}', last) + 1};
  }
  return {node.offset, std::min(text.find_first_of(" \t\r\n,]}", node.offset), text.size())};
}

Span key_span(const JsonMember& member) {
  return {member.key_offset, end_of_string(member.value.source->text, member.key_offset)};
}

std::string replaced(const std::string& text, Span span, const std::string& by) {
  return text.substr(0, span.begin) + by + text.substr(span.end);
}

std::string without(const std::string& text, const JsonMember& member) {
  constexpr const char* blanks = " \t\r\n";
  Span span{member.key_offset, span_of(member.value).end};
  const std::size_t before = text.find_last_not_of(blanks, span.begin - 1);
  const std::size_t after = text.find_first_not_of(blanks, span.end);
  if (text[after] == ',')
    span.end = after + 1;
  else if (text[before] == ',')
    span.begin = before;
  return replaced(text, span, "");
}

std::vector<std::string> misspellings(const std::string& key) {
  const std::size_t middle = key.size() / 2;
  std::vector<std::string> words = {key, key, key, key, key};
  words[0].erase(middle, 1);
  words[1].insert(middle, 1, key[middle]);
  words[2][middle] = 'z';
  words[3][0] = static_cast<char>(std::toupper(static_cast<unsigned char>(key[0])));
  if (key.size() > 1) std::swap(words[4][0], words[4][1]);
  words.erase(std::remove(words.begin(), words.end(), key), words.end());
  return words;
}

const std::vector<std::string>& odd_values() {
  static const std::vector<std::string> values = {
      // numbers, and what is none in JSON
      "-1", "0", "0.5", "1e38", "-1e38", "1e30", "1e400", "-1e400", "1e-320", "9007199254740993",
      "99999999999999999999", "NaN", "nan", "Infinity", "-Infinity", "-", "+1", ".5", "0x10", "1e",
      "01", "1.5.5", "--1",
      // other types
      "null", "true", "false", "{}", "[]", "[[]]", "[1]", "[1, 2]", "[1, 2, 3]", "[1, 2, 3, 4]",
      "[null, null, null]", "[1e38, 0, 0]", "[-1, -1, -1]", "[0, 0, 0]", "[1, 2, \"3\"]",
      "{\"type\": \"sphere\"}", "{\"srgb\": [1, 1, 1]}", "{\"srgb\": [1, 1]}", "{\"srgb\": 1}",
      "{\"\": 0}", "undefined", "",
      // texts
      "\"\"", "\"NaN\"", "\"1\"", "\"x\"", "\"\\u0000\"", "\"everything.obj\\u0000\"",
      "\"\\ud800\"", "\"\xff\xfe\"", "\"\n\"", "\"unclosed", "\"\\q\"", "'x'", "\"/\"",
      "\"../../../../etc/passwd\"", "\"/dev/zero\"", "\"%s%n%d {} {0}\"",
      "\"" + std::string(100000, 'x') + "\"",
      // sizes
      std::string(40, '[') + std::string(40, ']'), std::string(5000, '['),
      "[" + std::string(20000, ' ') + "]", "/* open"};
  return values;
}

void for_each_damage(const std::string& text, int cuts, int changes,
                     const std::function<void(const std::string& what, const std::string&)>& use) {
  use("empty", "");
  use("blanks", " \n\t\r\n");
  use("twice", text + text);
  use("one zero byte", std::string(1, '\0'));
  use("zero bytes", std::string(4096, '\0'));
  use("zero byte at the end", text + '\0');
  use("UTF-16", std::string("\xff\xfe{\0v\0", 6));
  use("a mark twice", "\xEF\xBB\xBF\xEF\xBB\xBF" + text);
  std::string returns = text;
  std::replace(returns.begin(), returns.end(), '\n', '\r');
  use("lines that end in CR", returns);
  Random random(1);
  std::string garbage;
  for (int i = 0; i < 4096; ++i) garbage += static_cast<char>(random.below(256));
  use("garbage", garbage);
  use("garbage at the end", text + garbage);
  for (int i = 0; i < cuts; ++i)
    use("cut", text.substr(0, text.size() * static_cast<std::size_t>(i) / std::size_t(cuts)));
  for (int i = 0; i < changes; ++i)
    use("random change " + std::to_string(i), with_random_changes(text, random));
}

}  // namespace pellucid::test

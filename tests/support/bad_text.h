// Ways to spoil a text file: values of a JSON text replaced in place, cuts, and random bytes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/json_tree.h"

namespace pellucid::test {

/// A piece of a text.
struct Span {
  std::size_t begin = 0, end = 0;
};

/// Where a value stands, from its first byte to behind its last. The text must be valid JSON whose
/// comments hold no brackets.
Span span_of(const JsonNode& node);
/// Where a key stands, with its quotes.
Span key_span(const JsonMember& member);

std::string replaced(const std::string& text, Span span, const std::string& by);
/// Without the member, and without the comma that it leaves over.
std::string without(const std::string& text, const JsonMember& member);

/// A key misspelt: a letter lost, doubled, another one, a capital, two swapped. None is `key`.
std::vector<std::string> misspellings(const std::string& key);

/// Values that hardly any key takes; what JSON cannot spell is among them.
const std::vector<std::string>& odd_values();

/// All damages of a file as such: cut at `cuts` places, empty, doubled, bytes changed at random
/// (`changes` times, the same for every run), marks and ends of lines of other systems.
void for_each_damage(const std::string& text, int cuts, int changes,
                     const std::function<void(const std::string& what, const std::string&)>& use);

}  // namespace pellucid::test

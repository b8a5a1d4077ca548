// Markup that is HTML and XML alike: elements with their ends, text escaped.
#pragma once

#include <string>
#include <vector>

namespace pellucid {

/// For text and attribute values; control characters, which XML forbids, become "?", and lines do
/// not break before "%".
std::string escaped(const std::string& text);

/// `attributes` as written in the tag; `content` is markup, "" makes <name/>: for elements that
/// HTML knows as void or SVG as empty.
std::string element(const std::string& name, const std::string& attributes,
                    const std::string& content = "");

/// `text` is escaped; never an empty element.
std::string text_element(const std::string& name, const std::string& attributes,
                         const std::string& text);

/// Cells are markup. `classes`: of the columns, "" for none; `row_classes` likewise.
struct HtmlTable {
  std::vector<std::string> head, classes;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> row_classes;
  std::string html() const;
};

/// <ul> of escaped items, "" if there are none.
std::string html_list(const std::vector<std::string>& items);

}  // namespace pellucid

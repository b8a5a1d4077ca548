// Elements, tables and lists as text.
#include "study/report/markup.h"

namespace pellucid {

std::string escaped(const std::string& text) {
  std::string safe;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const auto byte = static_cast<unsigned char>(c);
    if (c == ' ' && text.compare(i, 2, " %") == 0) {
      safe += "&#160;";
      continue;
    }
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      case '\n':
      case '\t':
        safe += c;
        break;
      default:
        safe += byte < 0x20 || byte == 0x7F ? '?' : c;
    }
  }
  return safe;
}

std::string element(const std::string& name, const std::string& attributes,
                    const std::string& content) {
  std::string text = "<" + name;
  if (!attributes.empty()) text += " " + attributes;
  if (content.empty()) return text + "/>\n";
  return text + ">" + content + "</" + name + ">\n";
}

std::string text_element(const std::string& name, const std::string& attributes,
                         const std::string& text) {
  return element(name, attributes, text.empty() ? "&#160;" : escaped(text));
}

std::string HtmlTable::html() const {
  const auto of = [](const std::vector<std::string>& names, std::size_t i) {
    return i < names.size() && !names[i].empty() ? "class=\"" + names[i] + "\"" : "";
  };
  std::string cells, body;
  for (std::size_t c = 0; c < head.size(); ++c)
    cells += text_element("th", of(classes, c), head[c]);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::string row;
    for (std::size_t c = 0; c < rows[r].size(); ++c)
      row += element("td", of(classes, c), rows[r][c].empty() ? "&#160;" : rows[r][c]);
    body += element("tr", of(row_classes, r), row);
  }
  const std::string table = element("thead", "", element("tr", "", cells)) +
                            (body.empty() ? "" : element("tbody", "", body));
  return element("div", "class=\"scroll\"", element("table", "", table));
}

std::string html_list(const std::vector<std::string>& items) {
  std::string list;
  for (const std::string& item : items) list += text_element("li", "", item);
  return list.empty() ? "" : element("ul", "", list);
}

}  // namespace pellucid

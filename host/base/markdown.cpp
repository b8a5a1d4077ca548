// Markdown tables, padded.
#include "base/markdown.h"

#include <algorithm>

namespace pellucid {
namespace {

/// Letters, not bytes, of UTF-8.
std::size_t letters(const std::string& text) {
  return std::size_t(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

std::string markdown_line(const std::string& text) {
  std::string clean;
  for (char c : text) {
    if (c == '|') clean += '\\';
    clean += c == '\n' || c == '\r' ? ' ' : c;
  }
  return clean;
}

std::string markdown_table(std::vector<std::vector<std::string>> rows, std::size_t first_number) {
  std::vector<std::size_t> widths(rows.front().size(), 3);
  for (std::vector<std::string>& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) {
      row[c] = markdown_line(row[c]);
      widths[c] = std::max(widths[c], letters(row[c]));
    }
  std::string text;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < rows[r].size(); ++c) {
      const std::string padding(widths[c] - letters(rows[r][c]), ' ');
      text += "| " + (c < first_number ? rows[r][c] + padding : padding + rows[r][c]) + " ";
    }
    text += "|\n";
    if (r > 0) continue;
    for (std::size_t c = 0; c < widths.size(); ++c)
      text += c < first_number ? "|" + std::string(widths[c] + 2, '-')
                               : "|" + std::string(widths[c] + 1, '-') + ":";
    text += "|\n";
  }
  return text;
}

}  // namespace pellucid

// Tables that read well as plain text and as Markdown.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace pellucid {

/// In one line and without what Markdown reads as a column's end.
std::string markdown_line(const std::string& text);

/// A table with its columns aligned; the first row is its head. Columns from `first_number` on are
/// aligned to the right.
std::string markdown_table(std::vector<std::vector<std::string>> rows,
                           std::size_t first_number = std::size_t(-1));

}  // namespace pellucid

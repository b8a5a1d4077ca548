// Tables: aligned in letters, one line per row, whatever the cells hold.
#include <gtest/gtest.h>

#include "base/markdown.h"

namespace pellucid {
namespace {

TEST(Markdown, ColumnsAreAligned) {
  EXPECT_EQ(markdown_table({{"scene", "x"}, {"bär", "12345"}}, 1),
            "| scene |     x |\n"
            "|-------|------:|\n"
            "| bär   | 12345 |\n");
}

TEST(Markdown, CellsStayInTheirColumn) {
  EXPECT_EQ(markdown_table({{"a|b"}, {"c\nd"}}), "| a\\|b |\n|------|\n| c d  |\n");
}

}  // namespace
}  // namespace pellucid

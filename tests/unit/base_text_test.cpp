// Nearest names, numbers for people, and broken invariants.
#include <gtest/gtest.h>

#include <limits>

#include "base/error.h"
#include "base/text.h"

namespace pellucid {
namespace {

TEST(Text, EditDistanceCountsSwapsOnce) {
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("relmse", "remlse"), 1);
  EXPECT_EQ(edit_distance("same", "same"), 0);
}

TEST(Text, SuggestsOnlyWhatIsNear) {
  const std::vector<std::string> names = {"render", "devices", "compare"};
  EXPECT_EQ(did_you_mean("compre", names), " Did you mean 'compare'?");
  EXPECT_EQ(did_you_mean("cornell-box", names), "");
  EXPECT_EQ(did_you_mean("x", {}), "");
  EXPECT_EQ(nearest_name("rendre", names), "render");
}

TEST(Text, BytesInPowersOf1024) {
  EXPECT_EQ(format_bytes(0), "0 B");
  EXPECT_EQ(format_bytes(1023), "1023 B");
  EXPECT_EQ(format_bytes(1536), "1.5 KiB");
  EXPECT_EQ(format_bytes(1048575), "1.0 MiB");
  EXPECT_EQ(format_bytes(std::uint64_t(2) << 30), "2.0 GiB");
}

TEST(Text, SecondsAsPeopleSayThem) {
  EXPECT_EQ(format_seconds(0.349), "0.35 s");
  EXPECT_EQ(format_seconds(12.34), "12.3 s");
  EXPECT_EQ(format_seconds(59.99), "1m00s");
  EXPECT_EQ(format_seconds(185.2), "3m05s");
  EXPECT_EQ(format_seconds(3599.9), "1h00m");
  EXPECT_EQ(format_seconds(7380), "2h03m");
  EXPECT_EQ(format_seconds(std::numeric_limits<double>::quiet_NaN()), "?");
}

TEST(Check, SaysWhatDoesNotHoldAndWhere) {
  try {
    PELLUCID_CHECK(1 > 2, "numbers are ordered");
    FAIL() << "no exception";
  } catch (const InternalError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("numbers are ordered (1 > 2 does not hold at "), std::string::npos);
    EXPECT_NE(message.find("base_text_test.cpp:"), std::string::npos);
    EXPECT_EQ(error.code(), ExitCode::internal);
  }
}

}  // namespace
}  // namespace pellucid

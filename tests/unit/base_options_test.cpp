// Values of command-line options: what people write is taken, anything doubtful is refused.
#include <gtest/gtest.h>

#include "apps/common.h"
#include "base/error.h"

namespace pellucid {
namespace {

template <typename F>
void expect_refused(F&& parse, const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    try {
      parse("--option", text);
      ADD_FAILURE() << "accepted '" << text << "'";
    } catch (const UsageError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.rfind("--option takes ", 0), 0u) << message;
      EXPECT_NE(message.find("'" + text + "'"), std::string::npos) << message;
    }
  }
}

TEST(Options, Numbers) {
  EXPECT_EQ(parse_number("--option", "1e-3"), 1e-3);
  EXPECT_EQ(parse_number("--option", "-2"), -2.0);
  expect_refused(parse_number, {"", "x", "1x", " 1", "1 ", "nan", "inf", "1e999", "1,5"});
}

TEST(Options, Fractions) {
  EXPECT_EQ(parse_fraction("--option", "1%"), 0.01);
  EXPECT_EQ(parse_fraction("--option", "0.5"), 0.5);
  expect_refused(parse_fraction, {"", "%", "1%%", "1 %", "nan%"});
}

TEST(Options, Durations) {
  EXPECT_EQ(parse_duration("--option", "90"), 90.0);
  EXPECT_EQ(parse_duration("--option", "0"), 0.0);
  EXPECT_EQ(parse_duration("--option", "60s"), 60.0);
  EXPECT_EQ(parse_duration("--option", "500ms"), 0.5);
  EXPECT_EQ(parse_duration("--option", "10m"), 600.0);
  EXPECT_EQ(parse_duration("--option", "1h30m"), 5400.0);
  EXPECT_EQ(parse_duration("--option", "1.5d"), 129600.0);
  expect_refused(parse_duration, {"", "s", "-1s", "-0", "1 s", "1y", "1h30", "1e", "nan", "infs"});
}

TEST(Options, Sizes) {
  EXPECT_EQ(parse_size("--option", "640x480"), std::make_pair(640, 480));
  EXPECT_EQ(parse_size("--option", "1x32768"), std::make_pair(1, 32768));
  expect_refused(parse_size, {"", "640", "x", "640x", "x480", "0x1", "-1x1", "1x65537", "1x1x1",
                              "640X480", "640 x 480", "1.5x2", "99999999999x1"});
}

}  // namespace
}  // namespace pellucid

// Every case of the stability suite, and the suite itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "base/error.h"
#include "scene/load.h"
#include "stability/suite.h"
#include "support/findings.h"
#include "support/kernel_folder.h"

namespace pellucid::test {
namespace {

using namespace stability;

Lab test_lab() {
  const char* tier = std::getenv("PELLUCID_TIER");
  const char* spec = std::getenv("PELLUCID_DEVICE");
  const double effort = tier && std::string(tier) == "full" ? 10 : 1;
  return {Device::open(spec ? spec : ""), kernel_folder(), effort, [](const std::string& name) {
            return load_scene(find_scene(name, {std::string(PELLUCID_SOURCE_DIR) + "/scenes"}));
          }};
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const Case& c : cases()) all.push_back(c.name);
  return all;
}

class Stability : public testing::TestWithParam<std::string> {};

TEST_P(Stability, holds) {
  const auto named = [&](const Case& c) { return c.name == GetParam(); };
  const Result result = run_case(*std::find_if(cases().begin(), cases().end(), named), test_lab());
  Findings findings;
  findings.checks = result.checks;
  if (result.verdict != Verdict::not_applicable) expect_all(findings);
  EXPECT_NE(result.verdict, Verdict::fail) << result.note;
}

INSTANTIATE_TEST_SUITE_P(Cases, Stability, testing::ValuesIn(names()), [](const auto& test) {
  std::string name = test.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(StabilitySuite, table_is_sound) {
  int last = 0;
  for (const Case& c : cases()) {
    EXPECT_GT(c.number, last) << c.name << ": by number, each once";
    EXPECT_LE(c.number, 38) << c.name;
    last = c.number;
    EXPECT_FALSE(c.name.empty() || c.title.empty() || c.methods.empty() || c.naive.empty());
    EXPECT_EQ(c.measure == nullptr, !c.why_not.empty()) << c.name;
  }
  EXPECT_EQ(cases().size() + missing_cases().size(), 38u);
}

Result run(Measurement measurement) {
  const Case c{1, "planted", "", "", "", measurement, ""};
  return run_case(c, test_lab());
}

// The judge itself.
TEST(StabilitySuite, judges) {
  EXPECT_EQ(run([](const Lab&, Findings&) {}).verdict, Verdict::fail) << "nothing measured";
  EXPECT_EQ(run([](const Lab&, Findings& f) { f.at_most("at", 1, 1); }).verdict, Verdict::pass);
  const Result beyond = run([](const Lab&, Findings& f) {
    f.at_most("below", 1, 2);
    f.at_most("beyond", 1.5, 1);
    f.none("none", 0);
  });
  EXPECT_EQ(beyond.verdict, Verdict::fail);
  ASSERT_NE(beyond.worst(), nullptr);
  EXPECT_EQ(beyond.worst()->what, "beyond");
  const auto not_a_number = [](const Lab&, Findings& f) { f.at_most("nan", std::nan(""), 1); };
  EXPECT_EQ(run(not_a_number).verdict, Verdict::fail);
  const Result thrown = run([](const Lab&, Findings&) { throw NumericError("3 nonfinite"); });
  EXPECT_EQ(thrown.verdict, Verdict::fail);
  EXPECT_EQ(thrown.note, "3 nonfinite");
  const Result warned = run([](const Lab&, Findings& f) {
    f.require("warns", true);
    f.warning = "beware";
  });
  EXPECT_EQ(warned.verdict, Verdict::warned);
  EXPECT_EQ(warned.note, "beware");
}

}  // namespace
}  // namespace pellucid::test

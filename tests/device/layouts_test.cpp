// The traversal in every way to build it: widths 4, 8 and 16, with and without compiler builtins.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "stability/measurements.h"
#include "support/findings.h"
#include "support/kernel_folder.h"

namespace pellucid::test {
namespace {

using namespace stability;

/// PELLUCID_TIER=full: as many rays as numerics.md asks for.
const Lab& lab() {
  static const Lab lab = [] {
    const char* tier = std::getenv("PELLUCID_TIER");
    return Lab{Device::open(""), kernel_folder(), tier && std::string(tier) == "full" ? 10.0 : 1.0};
  }();
  return lab;
}

TEST(Layouts, NoneLeaks) {
  for (const RayConfig& config : all_configs()) {
    Findings findings;
    aimed_rays_hit(lab(), findings, config);
    expect_all(findings);
  }
}

TEST(Layouts, InAllTheLowestOfDuplicatesWins) {
  for (const RayConfig& config : all_configs()) {
    Findings findings;
    lowest_of_duplicates_wins(lab(), findings, config);
    expect_all(findings);
  }
}

TEST(Layouts, AllGiveTheSameBits) {
  Findings findings;
  layouts_agree(lab(), findings);
  expect_all(findings);
}

}  // namespace
}  // namespace pellucid::test

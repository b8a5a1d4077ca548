// Findings of the stability suite as verdicts of tests.
#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <cstdio>

#include "stability/suite.h"

namespace pellucid::test {

inline void expect_all(const stability::Findings& findings) {
  EXPECT_FALSE(findings.checks.empty());
  for (const stability::Check& check : findings.checks) {
    std::printf("%s: %.4g, at most %.4g\n", check.what.c_str(), check.measured, check.bound);
    std::string key;
    for (char c : check.what) key += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    ::testing::Test::RecordProperty(key, std::to_string(check.measured));
    EXPECT_LE(check.measured, check.bound) << check.what;
  }
}

}  // namespace pellucid::test

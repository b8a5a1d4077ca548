// The first signal asks, the second one ends; SIGUSR1 asks for the image so far.
#include <gtest/gtest.h>

#include <csignal>

#include "base/error.h"
#include "base/signals.h"

namespace pellucid {
namespace {

TEST(StopSignal, FirstSignalOnlySetsTheFlag) {
  for (const int number : {SIGINT, SIGTERM}) {
    const StopSignal stop;
    EXPECT_FALSE(stop.stop_requested());
    std::raise(number);
    EXPECT_TRUE(stop.stop_requested());
    EXPECT_EQ(stop.number(), number);
  }
}

TEST(StopSignalDeathTest, SecondSignalEndsAtOnce) {
  EXPECT_EXIT(
      {
        const StopSignal stop;
        std::raise(SIGTERM);
        std::raise(SIGINT);
      },
      ::testing::ExitedWithCode(128 + SIGINT), "");
}

TEST(StopSignal, WriteRequestIsTakenOnce) {
  StopSignal stop;
  EXPECT_FALSE(stop.take_write_request());
  std::raise(SIGUSR1);
  std::raise(SIGUSR1);
  EXPECT_TRUE(stop.take_write_request());
  EXPECT_FALSE(stop.take_write_request());
  EXPECT_FALSE(stop.stop_requested());
}

TEST(StopSignalDeathTest, OldHandlersComeBack) {
  { const StopSignal stop; }
  EXPECT_EXIT(std::raise(SIGTERM), ::testing::KilledBySignal(SIGTERM), "");
}

TEST(StopSignal, OnlyOneLives) {
  const StopSignal stop;
  EXPECT_THROW(StopSignal(), InternalError);
}

}  // namespace
}  // namespace pellucid

// The clock of phases: nothing is lost, nothing counts twice.
#include <gtest/gtest.h>

#include <thread>

#include "base/phase_clock.h"

namespace pellucid {
namespace {

void wait() {
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

TEST(Phases, NestedScopesAddUp) {
  constexpr double already = 2.0, slept = 0.005;
  PhaseClock clock(Phase::start, already);
  {
    const PhaseScope outer(Phase::render, clock);
    wait();
    {
      const PhaseScope inner(Phase::write, clock);
      wait();
    }
    EXPECT_EQ(clock.now(), Phase::render);
  }
  EXPECT_EQ(clock.now(), Phase::start);
  EXPECT_GE(clock.seconds(Phase::start), already);
  EXPECT_GE(clock.seconds(Phase::render), slept);
  EXPECT_GE(clock.seconds(Phase::write), slept);
  EXPECT_EQ(clock.seconds(Phase::bvh), 0.0);
  const PhaseClock stopped = clock;  // copied, since it runs while parts are read
  double sum = 0;
#define X(name, meaning) sum += stopped.seconds(Phase::name);
  PHASES(X)
#undef X
  EXPECT_NEAR(sum, stopped.total(), 1e-3);
}

TEST(Phases, OtherThreadsDoNotCount) {
  PhaseClock clock(Phase::load);
  std::thread([&] { clock.enter(Phase::render); }).join();
  EXPECT_EQ(clock.now(), Phase::load);
}

TEST(Phases, TheProcessHasOne) {
  const double total = process_clock().total();
  EXPECT_GT(total, 0.0);
  wait();
  EXPECT_GT(process_clock().total(), total);
}

}  // namespace
}  // namespace pellucid

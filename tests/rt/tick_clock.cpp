#include "rt/tick_clock.h"

#include <gtest/gtest.h>

#include <thread>

#include "io/monotonic.h"

namespace feedtwin::rt {
namespace {

constexpr std::int64_t period_ns = 2'000'000;

void be_late_by(std::int64_t late_ns, std::int64_t planned_ns) {
  while (io::monotonic_ns() < planned_ns + late_ns) std::this_thread::yield();
}

/// Nothing here depends on how punctual the host is: only on the grid that the clock claims.
TEST(GridClock, StaysOnItsGridWhateverHappens) {
  for (const Overrun overrun : {Overrun::skip, Overrun::catch_up}) {
    GridClock clock(period_ns, overrun);
    const std::int64_t origin_ns = clock.start();
    std::int64_t grid_points = 0;
    for (int i = 0; i < 40; ++i) {
      const TickStart start = clock.wait();
      ASSERT_TRUE(start.proceed);
      grid_points += 1 + (overrun == Overrun::skip ? static_cast<std::int64_t>(start.missed) : 0);
      ASSERT_EQ(start.planned_ns, origin_ns + grid_points * period_ns) << "tick " << i;
      ASSERT_GE(start.woken_ns, start.planned_ns) << "tick " << i << " began before its time";
      if (i == 10) be_late_by(7 * period_ns + period_ns / 2, start.planned_ns);
    }
  }
}

TEST(GridClock, SkipCountsTheMissedOnesAndCatchUpRunsThem) {
  GridClock skipping(period_ns, Overrun::skip);
  skipping.start();
  be_late_by(5 * period_ns + period_ns / 2, skipping.wait().planned_ns);
  EXPECT_GE(skipping.wait().missed, 4U);

  GridClock catching(period_ns, Overrun::catch_up);
  catching.start();
  const TickStart first = catching.wait();
  be_late_by(5 * period_ns + period_ns / 2, first.planned_ns);
  int back_to_back = 0;
  for (TickStart next = catching.wait(); next.missed > 0; next = catching.wait()) ++back_to_back;
  EXPECT_GE(back_to_back, 4);
}

TEST(GridClock, StopEndsTheRunAtTheFirstMiss) {
  GridClock clock(period_ns, Overrun::stop);
  clock.start();
  const TickStart first = clock.wait();
  if (!first.proceed) GTEST_SKIP() << "this host was a whole period late by itself";
  be_late_by(3 * period_ns, first.planned_ns);
  EXPECT_FALSE(clock.wait().proceed);
}

TEST(OfflineClock, IsTheSameGridWithoutWaiting) {
  OfflineClock clock(period_ns);
  const std::int64_t origin = clock.start();
  for (int i = 0; i < 1000; ++i) {
    const TickStart start = clock.wait();
    ASSERT_EQ(start.woken_ns, origin + i * period_ns);
    ASSERT_EQ(start.missed, 0U);
  }
}

}  // namespace
}  // namespace feedtwin::rt

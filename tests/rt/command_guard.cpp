#include "rt/command_guard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace feedtwin::rt {
namespace {

using io::AxisRequest;
using io::DriveState;

constexpr std::int64_t ms = 1'000'000;

AxisRequest request(double torque_Nm, std::uint32_t sequence, std::int64_t arrival_ns, bool enable = true) {
  AxisRequest r;
  r.torque_Nm = torque_Nm;
  r.sequence = sequence;
  r.arrival_ns = arrival_ns;
  r.enable = enable;
  return r;
}

class Guarded : public ::testing::Test {
 protected:
  CommandGuard guard{{.torque_limit_Nm = 1.9, .watchdog_ns = 10 * ms}};
  CommandGuard::Decision give(const AxisRequest& r, std::int64_t now) { return guard.decide(r, true, now); }
  CommandGuard::Decision nothing(std::int64_t now) { return guard.decide(AxisRequest{}, false, now); }
};

TEST_F(Guarded, NothingActsBeforeItIsEnabled) {
  EXPECT_EQ(nothing(0).torque_Nm, 0.0);
  EXPECT_LT(nothing(1).age_ns, 0);
  EXPECT_EQ(give(request(0.5, 1, 0, false), 1 * ms).torque_Nm, 0.0);
  EXPECT_EQ(guard.state(), DriveState::disabled);
}

TEST_F(Guarded, HoldsUntilTheWatchdogThenZeroUntilReset) {
  EXPECT_EQ(give(request(0.5, 1, 0), 0).torque_Nm, 0.5);
  EXPECT_EQ(nothing(5 * ms).torque_Nm, 0.5) << "held";
  EXPECT_EQ(nothing(10 * ms).torque_Nm, 0.5) << "exactly as old as allowed";
  const auto tripped = nothing(11 * ms);
  EXPECT_EQ(tripped.torque_Nm, 0.0);
  ASSERT_TRUE(tripped.event.has_value());
  EXPECT_EQ(*tripped.event, EventKind::watchdog);
  EXPECT_EQ(guard.state(), DriveState::fault);
  EXPECT_EQ(give(request(0.5, 2, 12 * ms), 12 * ms).torque_Nm, 0.0) << "a command alone does not clear a fault";
  AxisRequest reset = request(0.4, 3, 13 * ms);
  reset.fault_reset = true;
  EXPECT_EQ(give(reset, 13 * ms).torque_Nm, 0.0);
  EXPECT_EQ(guard.state(), DriveState::disabled);
  EXPECT_EQ(give(request(0.4, 4, 14 * ms), 14 * ms).torque_Nm, 0.4);
  EXPECT_EQ(guard.counters().watchdog, 1U);
}

TEST_F(Guarded, ARequestMayNameAShorterWatchdogTime) {
  AxisRequest r = request(0.5, 1, 0);
  r.watchdog_ns = 2 * ms;
  give(r, 0);
  EXPECT_EQ(nothing(2 * ms).torque_Nm, 0.5);
  EXPECT_EQ(nothing(3 * ms).torque_Nm, 0.0);
}

TEST_F(Guarded, TakingEnableAwayAndGivingItAgainClearsAFault) {
  give(request(0.5, 1, 0), 0);
  nothing(50 * ms);
  ASSERT_EQ(guard.state(), DriveState::fault);
  give(request(0.5, 2, 51 * ms, false), 51 * ms);
  EXPECT_EQ(guard.state(), DriveState::fault);
  give(request(0.5, 3, 52 * ms), 52 * ms);
  EXPECT_EQ(give(request(0.5, 4, 53 * ms), 53 * ms).torque_Nm, 0.5);
}

TEST_F(Guarded, AControllerThatStartsAfreshMayEnableAtOnceAfterAFault) {
  EXPECT_EQ(give(request(0.5, 100, 0), 0).torque_Nm, 0.5);
  EXPECT_EQ(nothing(11 * ms).torque_Nm, 0.0);
  EXPECT_EQ(give(request(0.5, 100 + restart_distance - 1, 12 * ms), 12 * ms).torque_Nm, 0.0);
  EXPECT_EQ(guard.state(), DriveState::fault) << "the same controller has to reset it";
  give(request(0.4, 100 + 3 * restart_distance, 13 * ms), 13 * ms);
  EXPECT_EQ(guard.state(), DriveState::disabled);
  EXPECT_EQ(nothing(14 * ms).torque_Nm, 0.4);
}

TEST_F(Guarded, QuickStopTakesTheTorqueAndGivesItBack) {
  give(request(0.5, 1, 0), 0);
  AxisRequest stop = request(0.5, 2, ms);
  stop.quick_stop = true;
  EXPECT_EQ(give(stop, ms).torque_Nm, 0.0);
  EXPECT_EQ(guard.state(), DriveState::quick_stop);
  EXPECT_EQ(give(request(0.5, 3, 2 * ms), 2 * ms).torque_Nm, 0.5);
}

TEST_F(Guarded, SequencesAreCounted) {
  give(request(0.1, 10, 0), 0);
  give(request(0.2, 10, ms), ms);          // repeated, used
  give(request(0.3, 14, 2 * ms), 2 * ms);  // 11, 12, 13 lost
  EXPECT_EQ(give(request(0.9, 12, 3 * ms), 3 * ms).torque_Nm, 0.3) << "an old command does not act";
  give(request(0.4, 3'000'000, 4 * ms), 4 * ms);  // a controller that started afresh
  EXPECT_EQ(guard.counters().repeated, 1U);
  EXPECT_EQ(guard.counters().lost, 3U);
  EXPECT_EQ(guard.counters().reordered, 1U);
}

TEST_F(Guarded, AControllerThatDoesNotCountRepeatsNothing) {
  AxisRequest r = request(0.1, 0, 0);
  r.counted = false;
  give(r, 0);
  EXPECT_EQ(give(r, 1 * ms).torque_Nm, 0.1);
  EXPECT_EQ(guard.counters().repeated, 0U);
}

TEST_F(Guarded, WhatANewerOneReplacedIsNotLost) {
  give(request(0.1, 1, 0), 0);
  AxisRequest r = request(0.1, 6, 0);
  r.superseded = 3;
  give(r, 0);
  EXPECT_EQ(guard.counters().lost, 1U) << "2 to 5: three came and were replaced";
}

TEST_F(Guarded, SequencesWrapAround) {
  give(request(0.1, 0xFFFFFFFFU, 0), 0);
  EXPECT_EQ(give(request(0.2, 0, ms), ms).torque_Nm, 0.2);
  EXPECT_EQ(guard.counters().lost + guard.counters().reordered, 0U);
}

TEST_F(Guarded, AnythingInInAFiniteTorqueWithinTheLimitOut) {
  std::mt19937_64 random(7);
  const double odd[] = {0.0,
                        -0.0,
                        1.9,
                        -1.9,
                        1e308,
                        -1e308,
                        5e-324,
                        std::nan(""),
                        std::numeric_limits<double>::infinity(),
                        -std::numeric_limits<double>::infinity()};
  std::int64_t now = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    now += static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(4 * ms));
    AxisRequest r = request(odd[random() % 10], static_cast<std::uint32_t>(random() % 40), now, random() % 8 != 0);
    r.arrival_ns = now - static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(20 * ms));
    r.quick_stop = random() % 16 == 0;
    r.fault_reset = random() % 4 == 0;
    const auto decision = guard.decide(r, random() % 3 != 0, now);
    ASSERT_TRUE(std::abs(decision.torque_Nm) <= 1.9) << "step " << i << ", torque asked " << r.torque_Nm;
    if (decision.torque_Nm != 0.0) {
      ASSERT_EQ(guard.state(), DriveState::enabled) << "step " << i;
      ASSERT_LE(decision.age_ns, 10 * ms) << "step " << i;
    }
  }
  EXPECT_GT(guard.counters().refused, 0U);
  EXPECT_GT(guard.counters().clipped, 0U);
  EXPECT_GT(guard.counters().watchdog, 0U);
}

}  // namespace
}  // namespace feedtwin::rt

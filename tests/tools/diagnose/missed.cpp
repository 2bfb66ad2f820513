// What a name must be missed by in closed loop.

#include "tools/diagnose/forward/missed.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tools/diagnose/forward/confirm.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

Found found(std::string_view id, bool by_closed_loop = false) {
  Found one;
  one.effect.hypothesis = &hypothesis(id);
  one.by_closed_loop = by_closed_loop;
  return one;
}

TEST(NatsToStay, ATorqueConstantNeedsFewerWhereTheNumbersWouldBeFarOff) {
  EXPECT_DOUBLE_EQ(nats_to_stay(found("torque_gain_error")), 500.0);
  EXPECT_DOUBLE_EQ(nats_to_stay(found("torque_gain_error"), 30.0), 500.0);
  EXPECT_DOUBLE_EQ(nats_to_stay(found("torque_gain_error"), 129.0), 100.0);
}

TEST(NatsToStay, ATorqueConstantNeedsMoreWhereItPutsTheNumbersFartherFromNominal) {
  EXPECT_DOUBLE_EQ(nats_to_stay(found("torque_gain_error"), -17.0), 2000.0);
  EXPECT_DOUBLE_EQ(nats_to_stay(found("hidden_friction_compensation"), -17.0), 5e4);  // numbers do not take that up
  EXPECT_DOUBLE_EQ(nats_to_stay(found("payload"), -17.0), 15.0);
}

TEST(NatsToStay, AWeightNeedsMoreWhereTheNumbersAreClearlyBetterWithout) {
  EXPECT_DOUBLE_EQ(nats_to_stay(found("gravity")), 150.0);
  EXPECT_DOUBLE_EQ(nats_to_stay(found("gravity"), -2.0), 150.0);
  EXPECT_DOUBLE_EQ(nats_to_stay(found("gravity"), -23.0), 600.0);
}

TEST(NatsToStay, WhatNumbersCouldDoNeedsMoreThanItPutsThemOff) {
  for (const char* id : {"gravity", "torque_offset", "payload"}) {
    EXPECT_DOUBLE_EQ(nats_to_stay(found(id), -930.0), 1860.0) << id;
    EXPECT_LE(nats_to_stay(found(id), -2.0), 150.0) << id;
  }
  Found explains_most = found("torque_offset");
  explains_most.error_ratio = 5.02;
  EXPECT_DOUBLE_EQ(nats_to_stay(explains_most, -930.0), 1860.0);
  EXPECT_DOUBLE_EQ(nats_to_stay(found("cogging"), -20.0), 15.0);
}

// A law of speed that was none was missed by -8 nats and put the numbers 150 squared tolerances off; of true names a cogging
// by 15691 and 107, a stop by 753 and 35.
TEST(NatsToStay, WhatPutsTheNumbersFarOffNeedsMoreThanThat) {
  EXPECT_GT(nats_to_stay(found("sublinear_viscous"), -150.0), 100.0);
  EXPECT_LT(nats_to_stay(found("cogging"), -107.0), 1500.0);
  EXPECT_LT(nats_to_stay(found("hard_stop"), -35.0), 753.0);
}

// A lag of the current loop that was missed by 86100 nats left 633 of a warm-up that was none.
TEST(NatsBeside, AStrongNameExcusesTheWeakOneThatAnySmoothChangeIs) {
  EXPECT_GT(nats_beside(hypothesis("thermal_friction"), 86100.0), 633.0);
  EXPECT_LT(nats_beside(hypothesis("thermal_friction"), 13538.0), 736.0);  // a true one beside cogging
  EXPECT_LT(nats_beside(hypothesis("copper_loss"), 86100.0), 0.0);
}

TEST(NatsToStay, ACompensationNeedsFewerWhereTheNumbersWouldBeFarOff) {
  EXPECT_DOUBLE_EQ(nats_to_stay(found("hidden_friction_compensation"), 0.0), 5e4);
  EXPECT_DOUBLE_EQ(nats_to_stay(found("hidden_friction_compensation"), 190.0), 6000.0);
}

TEST(NatsToStay, ACompensationNeedsFewerWhereItSetsInFasterThanAReversal) {
  Found one = found("hidden_friction_compensation");
  one.effect.q = {0.01, 2.5e-3, 0.0, 1.0};
  EXPECT_DOUBLE_EQ(nats_to_stay(one), 5e4);
  one.effect.q[1] = 4.5e-3;
  EXPECT_DOUBLE_EQ(nats_to_stay(one), 1400.0);
  one.effect.q[2] = -7e-4;
  EXPECT_DOUBLE_EQ(nats_to_stay(one), 5e4) << "what comes after the motion is friction's";
  one.effect.q[3] = 0.0;
  EXPECT_DOUBLE_EQ(nats_to_stay(one), 1400.0) << "after the set point is not after the motion";
}

TEST(NatsToStay, AWarmUpOfAFewPerCentMustBeMissedByMore) {
  for (const char* id : {"thermal_friction", "thermal_friction_of_all"}) {
    Found one;
    one.effect = {&hypothesis(id), {0.007, 7.4, 0.0}};
    EXPECT_DOUBLE_EQ(nats_to_stay(one), 400.0) << id;
    one.effect.q[0] = 0.1;
    EXPECT_DOUBLE_EQ(nats_to_stay(one), 150.0) << id;
  }
}

TEST(NatsToStay, FrictionByTheLoadNeedsMoreThanADelayLeavesOver) {
  EXPECT_GT(nats_to_stay(found("load_dependent_friction")), 64.0);
  EXPECT_LT(nats_to_stay(found("load_dependent_friction")), 166.0);
}

// One that gained 150 about reversals took the place of a true copper loss, and went for want of 5850 nats.
TEST(MayBeMissedEnough, IsAskedOfWhatWouldTakeAnothersPlace) {
  Active compensation{&hypothesis("hidden_friction_compensation"), {0.004, 5e-4, 0.0, 1.0}};
  EXPECT_FALSE(may_be_missed_enough(compensation, 150.0));
  EXPECT_TRUE(may_be_missed_enough(compensation, 2000.0));
  compensation.q[1] = 8e-3;
  EXPECT_TRUE(may_be_missed_enough(compensation, 150.0));
  EXPECT_TRUE(may_be_missed_enough({&hypothesis("cogging"), {}}, 30.0));
}

TEST(NatsToStay, OthersNeedAsManyWhereverTheNumbersAre) {
  for (const double farther : {0.0, 129.0}) {
    EXPECT_DOUBLE_EQ(nats_to_stay(found("cogging"), farther), 15.0);
    EXPECT_DOUBLE_EQ(nats_to_stay(found("hard_stop"), farther), 20.0);
    EXPECT_DOUBLE_EQ(nats_to_stay(found("payload", true), farther), 100.0);
  }
}

TEST(NatsToStay, ACompensationNeedsFewerWhereItExplainsMost) {
  Found one = found("hidden_friction_compensation");
  one.error_ratio = 15.9;
  EXPECT_DOUBLE_EQ(nats_to_stay(one), 500.0);
  one.error_ratio = 4.8;
  EXPECT_DOUBLE_EQ(nats_to_stay(one), 5e4);
  one.error_ratio = 2.08, one.strength = 6.7;  // on an axis that the disturbance hides in closed loop
  EXPECT_DOUBLE_EQ(nats_to_stay(one), 5e4) << "not on every stretch";
  one.held_everywhere = true;
  EXPECT_DOUBLE_EQ(nats_to_stay(one), 500.0);
  one.strength = 0.52;  // a false one, about reversals
  EXPECT_DOUBLE_EQ(nats_to_stay(one), 5e4);
  Found other = found("cogging");
  other.error_ratio = 15.9;
  EXPECT_DOUBLE_EQ(nats_to_stay(other), 15.0);
}

// What reversals leave looks late too, and is likelier so: a late sensor is a channel far worse without it.
TEST(AskedOncePolished, ALateSensorMustMoveItsChannel) {
  const auto asked = [](std::string_view id, double error_ratio, bool everywhere = true) {
    Found one = found(id);
    one.error_ratio = error_ratio, one.held_everywhere = everywhere;
    return asked_once_polished(one);
  };
  EXPECT_FALSE(asked("channel_skew", 1.18));
  EXPECT_TRUE(asked("channel_skew", 1.44));
  EXPECT_TRUE(asked("cogging", 1.0));
  EXPECT_FALSE(asked("cogging", 1.0, false));
}

// Newtons of structure, of what is left over, as seen with a name and without it.
TEST(LeavesStructure, WhereWhatGoesBringsBackMoreThanAName) {
  const auto left = [](double structured_N, double remainder_N) {
    Structure structure;
    structure.remainder_N = remainder_N, structure.share = std::pow(structured_N / remainder_N, 2);
    return structure;
  };
  EXPECT_TRUE(leaves_structure(20.0, left(0.9, 3.5), left(1.9, 4.3))) << "a screw that warms up";
  EXPECT_TRUE(leaves_structure(20.0, left(0.58, 1.8), left(0.87, 2.1))) << "friction that lags";
  EXPECT_FALSE(leaves_structure(20.0, left(0.77, 1.3), left(0.76, 1.3))) << "a bite of something else";
  EXPECT_FALSE(leaves_structure(20.0, left(0.01, 0.4), left(0.3, 0.5))) << "too little to be unknown";
  EXPECT_FALSE(leaves_structure(20.0, left(0.3, 6.0), left(1.0, 6.0))) << "a trace of what is left over";
  EXPECT_TRUE(leaves_structure(8.0, left(0.9, 3.5), left(1.9, 4.3))) << "a cable's spring, to the closed loop half a colour";
  EXPECT_TRUE(leaves_structure(8.0, left(0.01, 0.24), left(0.21, 0.34), true)) << "the only name, of a small axis";
  EXPECT_FALSE(leaves_structure(8.0, left(0.01, 0.24), left(0.21, 0.34))) << "beside other names";
  EXPECT_FALSE(leaves_structure(1.0, left(0.9, 3.5), left(1.9, 4.3))) << "as likely without";
}

}  // namespace
}  // namespace feedtwin

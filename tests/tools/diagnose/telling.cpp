// What the closed loop must say of one effect more.

#include "tools/diagnose/forward/telling.h"

#include <gtest/gtest.h>

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

Answered answered(double nats, double deviations, double nearer_nominal, double ratio = 1.05, double share = 0.05) {
  return {nats, deviations, nearer_nominal, ratio, share, true};
}

TEST(Telling, AnOffsetThatTakesTheNumbersFarFromNominalIsNone) {
  const auto& offset = hypothesis("torque_offset");
  EXPECT_EQ(telling_of(offset, answered(530.0, 6.3, 10.0)), Telling::by_runs_alone);
  EXPECT_EQ(telling_of(offset, answered(530.0, 6.3, -197.0)), Telling::nothing);
  EXPECT_EQ(telling_of(hypothesis("torque_gain_error"), answered(505.0, 5.9, -5.0, 1.69, 0.53)), Telling::nothing);
  EXPECT_EQ(telling_of(offset, answered(264.0, 4.7, -22.0, 2.43, 0.61)), Telling::nothing) << "though a channel is closer";
}

TEST(Telling, WhatNumbersTakeUpNeedsMoreThanAChannelThatComesCloser) {
  EXPECT_EQ(telling_of(hypothesis("torque_offset"), answered(184.0, 3.7, -2.0, 3.07, 0.69)), Telling::nothing);
  EXPECT_EQ(telling_of(hypothesis("torque_offset"), answered(184.0, 4.7, 2.0, 3.07, 0.69)), Telling::by_channel);
  EXPECT_EQ(telling_of(hypothesis("quadratic_drag"), answered(184.0, 3.7, -2.0, 3.07, 0.69)), Telling::by_channel);
}

TEST(Telling, WhatNumbersTakeUpInMostStretchesMayShowInAFew) {
  const auto& offset = hypothesis("torque_offset");
  EXPECT_EQ(telling_of(offset, answered(258.0, 2.7, 16.0, 4.03, 0.86)), Telling::by_channel);
  EXPECT_EQ(telling_of(offset, answered(258.0, 2.7, 5.0, 4.03, 0.86)), Telling::nothing);
  EXPECT_EQ(telling_of(offset, answered(258.0, 2.7, 16.0, 2.5, 0.86)), Telling::nothing);
  EXPECT_EQ(telling_of(offset, answered(258.0, 2.7, 16.0, 4.03, 0.7)), Telling::nothing);
  EXPECT_EQ(telling_of(offset, answered(258.0, 1.5, 16.0, 4.03, 0.86)), Telling::nothing);
  EXPECT_EQ(telling_of(offset, answered(150.0, 2.7, 16.0, 4.03, 0.86)), Telling::nothing);
}

TEST(Telling, NumbersThatComeFarNearerToTheFileTellBesideAChannelInDoubt) {
  const auto& gain = hypothesis("torque_gain_error");
  const auto answer = [](double nearer, double deviations, double ratio) {
    Answered large = answered(3396.0, deviations, nearer, ratio, 0.43);
    large.slight = false;
    return large;
  };
  EXPECT_EQ(telling_of(gain, answer(267.0, 10.1, 1.59)), Telling::by_channel);
  EXPECT_EQ(telling_of(gain, answer(30.0, 10.1, 1.59)), Telling::nothing);
  EXPECT_EQ(telling_of(gain, answer(267.0, 0.5, 1.59)), Telling::nothing);
  EXPECT_EQ(telling_of(gain, answer(267.0, 10.1, 1.1)), Telling::nothing);
  EXPECT_EQ(telling_of(hypothesis("quadratic_drag"), answer(267.0, 10.1, 1.4)), Telling::nothing) << "no number takes it up";
}

TEST(Telling, AChannelThatComesHalfOfTheWayTellsWhereTheRunsAreSure) {
  const auto& dwell = hypothesis("dwell_breakaway");
  EXPECT_EQ(telling_of(dwell, answered(1404.0, 9.0, 11.0, 1.40, 0.46)), Telling::by_channel);
  EXPECT_EQ(telling_of(dwell, answered(1404.0, 5.0, 11.0, 1.40, 0.46)), Telling::nothing);
  EXPECT_EQ(telling_of(dwell, answered(900.0, 9.0, 11.0, 1.40, 0.46)), Telling::nothing);
  EXPECT_EQ(telling_of(dwell, answered(1404.0, 9.0, 11.0, 1.25, 0.46)), Telling::nothing);
  EXPECT_EQ(telling_of(hypothesis("torque_offset"), answered(1404.0, 9.0, -1.0, 1.40, 0.46)), Telling::nothing);
}

TEST(Telling, AChannelThatComesAllOfItsWayTellsThoughStretchesDisagree) {
  const auto& gravity = hypothesis("gravity");
  EXPECT_EQ(telling_of(gravity, answered(448.0, 0.8, -2.0, 11.8, 0.97)), Telling::by_channel);
  EXPECT_EQ(telling_of(gravity, answered(448.0, -0.8, -2.0, 11.8, 0.97)), Telling::nothing);
  EXPECT_EQ(telling_of(gravity, answered(448.0, 0.0, -2.0, 11.8, 0.97)), Telling::nothing) << "a single stretch has none";
  EXPECT_EQ(telling_of(gravity, answered(448.0, 0.8, -2.0, 11.8, 0.8)), Telling::nothing);
  EXPECT_EQ(telling_of(gravity, answered(448.0, 0.8, -2.0, 3.0, 0.97)), Telling::nothing);
  EXPECT_EQ(telling_of(gravity, answered(1237.0, 7.1, -200.0, 17.55, 1.01)), Telling::nothing) << "the numbers say no";
  EXPECT_EQ(telling_of(hypothesis("torque_offset"), answered(448.0, 0.8, 2.0, 11.8, 0.97)), Telling::nothing);
}

TEST(Telling, NatsAloneTellOnlyWhatMayBeToldSo) {
  EXPECT_EQ(telling_of(hypothesis("quadratic_drag"), answered(3000.0, 6.3, 0.0)), Telling::nothing);
  EXPECT_EQ(telling_of(hypothesis("torque_offset"), answered(90.0, 6.3, 0.0)), Telling::nothing);
  Answered large = answered(530.0, 6.3, 0.0);
  large.slight = false;
  EXPECT_EQ(telling_of(hypothesis("torque_offset"), large), Telling::nothing);
}

TEST(Telling, WhatWouldBeTakenOutAgainIsNotTold) {
  const auto& compensation = hypothesis("hidden_friction_compensation");
  EXPECT_EQ(telling_of(compensation, answered(2900.0, 6.8, 590.0, 4.77, 0.87)), Telling::nothing);
  EXPECT_EQ(telling_of(compensation, answered(3475.0, 11.7, 13.0, 94.2, 1.0)), Telling::by_channel);
  EXPECT_EQ(telling_of(hypothesis("friction_drift"), answered(130.0, 6.8, 0.0, 4.77, 0.87)), Telling::nothing);
  EXPECT_EQ(telling_of(hypothesis("direction_dependent_friction"), answered(196.0, 6.8, 0.0, 4.77, 0.87)), Telling::nothing);
}

}  // namespace
}  // namespace feedtwin

// What is told of a finding, however it was come by.

#include "tools/diagnose/reported.h"

#include <gtest/gtest.h>

#include "tests/support/made_case.h"
#include "tests/tools/diagnose/fitted_runs.h"
#include "tests/tools/diagnose/named_effect.h"
#include "tools/diagnose/judge.h"
#include "tools/diagnose/sentence.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;
using tests::named;

TEST(SentenceOf, WhatTheClosedLoopAloneTellsIsNoShareOfTheInverseModelsRemainder) {
  NamedEffect effect = named("torque_offset", "offset_Nm", 3e-3);
  effect.share = 0.0;
  EXPECT_NE(sentence_of(effect).find("It makes 0 %"), std::string::npos);
  effect.by_closed_loop = true;
  EXPECT_EQ(sentence_of(effect).find("It makes"), std::string::npos);
  EXPECT_NE(sentence_of(effect).find("simulated motion tells it"), std::string::npos);
}

TEST(SentenceOf, WhatAllNumbersCouldMakeUpForTogetherSaysThatThatTellsIt) {
  NamedEffect effect = named("sensor_gain", "force_sensor_gain", 0.85);
  effect.by_closed_loop = effect.by_common_shift = true;
  EXPECT_NE(sentence_of(effect).find("off by the same share"), std::string::npos);
  EXPECT_EQ(sentence_of(effect).find("simulated motion tells it"), std::string::npos);
}

TEST(NamedEffect, AnotherLawOfTheSamePhysicsIsNoAlternative) {
  const auto axis = plant::source_axis();
  const tests::FittedRuns fitted({tests::make_recording(axis, {.motion = "sine", .duration_s = 4.0})}, axis);
  Found found;
  found.effect = {&hypothesis("position_friction"), {0.2, 0.0, 0.0}};
  found.rivals = {&hypothesis("position_friction_wave"), &hypothesis("local_friction"), &hypothesis("local_friction")};
  const auto fit = fitted.fitter.fit({axis, {found.effect}}, fitted.whitening, 2);
  const auto told = named_effect(found, fit, robust_covariance(fitted.model, fit), fitted.model);
  EXPECT_EQ(told.alternatives, std::vector<std::string>{"local_friction"});
}

// However well the runs hold a number, its law is a simplification; where a line stands is none.
TEST(NamedEffect, IsNoSurerOfASizeThanItsLawIs) {
  const auto axis = plant::source_axis();
  const tests::FittedRuns fitted({tests::make_recording(axis, {.motion = "sine", .duration_s = 4.0})}, axis);
  const auto& law = hypothesis("floor_vibration");
  Found found;
  found.effect = {&law, {3.0, 4.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 20.0}};
  Fit fit = fitted.fitter.linearised({axis, {found.effect}}, fitted.whitening);
  fit.covariance *= 1e-8;
  const auto told = named_effect(found, fit, fit.covariance, fitted.model);
  ASSERT_EQ(told.parameters.size(), 2U);
  for (const auto& [name, estimate] : told.parameters) {
    const double share = 0.5 * (estimate.high - estimate.low) / estimate.value;
    if (name == "acceleration_m_per_s2")
      EXPECT_NEAR(share, 1.645 * law.law_error, 1e-3);
    else
      EXPECT_LT(share, 1e-3) << name;
  }
}

TEST(ChannelOf, AGainIsReadOffTheSensorThatHasIt) {
  const Hypothesis& gain = hypothesis("sensor_gain");
  EXPECT_EQ(channel_of({&gain, {0.1, 0.0, 0.0}}), "torque_sensor_Nm");
  EXPECT_EQ(channel_of({&gain, {0.0, 0.1, 1.0}}), "force_sensor_N");
  EXPECT_EQ(channel_of({&hypothesis("copper_loss"), {10.0}}), "power_W");
}

}  // namespace
}  // namespace feedtwin

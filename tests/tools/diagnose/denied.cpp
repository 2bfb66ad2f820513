// Names that runs which were not fitted deny.

#include "tools/diagnose/denied.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/tools/diagnose/cogged.h"
#include "tests/tools/diagnose/named_effect.h"
#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/holdout.h"
#include "tools/diagnose/sentence.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

/// What is left of a diagnosis that names a ripple of this many times the runs' own.
struct Told {
  tests::Cogged cogged;
  Diagnosis result;
  bool taken_back;

  /// @param by_force how many times as far off the names leave the force along the recorded motion
  /// @param error_ratio how many times as far off the fitted runs are without them
  /// @param share how much of what they are farther off the names make
  explicit Told(double times, double by_force = 1.0, double error_ratio = 1.0, double share = 1.0) {
    const double amplitude_Nm = 0.01 * times;
    SearchResult found;
    found.recalibrated.model = cogged.nominal;
    Found one;
    one.effect.hypothesis = &hypothesis("cogging");
    one.p_false_alarm = 0.001;
    one.error_ratio = error_ratio;
    found.found.push_back(one);
    plant::AxisParameters axis = cogged.data.axis;
    axis.effects.push_back(tests::effect("cogging", {{"amplitude_Nm", amplitude_Nm}, {"cycles_per_rev", 8.0}}));
    result.verdict = "named";
    result.effects.push_back(tests::named("cogging", "amplitude_Nm", amplitude_Nm));
    result.updated = axis;
    result.holdout = figures(cogged.forward, cogged.data.axis, extended(cogged.nominal), axis);
    result.holdout_inverse["torque_cmd_Nm"] = {.before = 1.0, .recalibrated = 1.0, .after = by_force};
    const auto& torque = result.holdout.at("torque_cmd_Nm");
    const double more = std::pow(torque.after, 2) - std::pow(torque.recalibrated, 2);
    result.holdout_inverse["torque_cmd_Nm"].by_effects = share * std::sqrt(std::max(0.0, more));
    taken_back = taken_back_if_denied(result, found);
  }
};

TEST(Denied, ANameThatBringsUnseenRunsCloserStays) {
  const Told told(1.0);
  EXPECT_FALSE(told.taken_back);
  EXPECT_EQ(told.result.verdict, "named");
  EXPECT_EQ(told.result.effects.size(), 1U);
  EXPECT_EQ(told.result.updated.effects.size(), 1U);
  EXPECT_EQ(told.result.denied_by_unseen, 0.0);
}

TEST(Denied, NotByTheClosedLoopAloneWhereTheForceAlongTheMotionBearsTheNameOut) {
  EXPECT_FALSE(Told(30.0, 0.5 * borne_out_ratio).taken_back);
  EXPECT_TRUE(Told(30.0, 1.1 * borne_out_ratio).taken_back);
}

TEST(Denied, NotWhereTheFittedRunsAreUnthinkableWithoutIt) {
  constexpr double somewhat = 2.4, much = 3.0;  // times the ripple: 1.37 and 1.95 times as far off
  EXPECT_FALSE(Told(somewhat, 1.0, 1.1 * beyond_denial_ratio).taken_back);
  EXPECT_TRUE(Told(somewhat, 1.0, 0.9 * beyond_denial_ratio).taken_back);
  EXPECT_TRUE(Told(much, 1.0, 1.1 * beyond_denial_ratio).taken_back);
}

TEST(Denied, NotWhereTheNumbersBesideItBringThemThere) {
  EXPECT_FALSE(Told(30.0, 1.0, 1.0, 0.9 * least_share_of_harm).taken_back);
  EXPECT_TRUE(Told(30.0, 1.0, 1.0, 1.1 * least_share_of_harm).taken_back);
}

TEST(Denied, ANameThatLeavesThemMuchFartherOffIsTakenBackAndSaid) {
  const Told told(30.0);
  EXPECT_TRUE(told.taken_back);
  EXPECT_EQ(told.result.verdict, "cannot-tell");
  EXPECT_TRUE(told.result.effects.empty());
  EXPECT_TRUE(told.result.updated.effects.empty()) << "what runs on must be what the runs bear out";
  EXPECT_GT(told.result.denied_by_unseen, denied_ratio);
  ASSERT_EQ(told.result.suspects.size(), 1U);
  EXPECT_EQ(told.result.suspects.front().hypothesis->id, "cogging");
  for (const auto* verdict : {"cannot-tell", "named"}) {  // a fault in the set-up may stand beside it
    Diagnosis said = told.result;
    said.verdict = verdict;
    const auto text = summary_of(said);
    EXPECT_NE(text.find("(cogging) leaves runs that were not fitted"), std::string::npos) << text;
  }
}

TEST(Denied, NumbersThatRecalibrationHoldsAsWellAreGivenMore) {
  for (const double times_as_far : {1.05, 1.5, 2.5})
    for (const char* id : {"cogging", "payload"}) {
      Diagnosis result;
      SearchResult found;
      found.found.emplace_back().effect.hypothesis = &hypothesis(id);
      result.effects.push_back(tests::named(id, "amplitude_Nm", 1.0));
      result.holdout["torque_cmd_Nm"].recalibrated = 0.01;
      result.holdout["torque_cmd_Nm"].after = 0.01 * times_as_far;
      result.holdout_inverse["torque_cmd_Nm"].by_effects = 0.1;
      const double most = std::string_view(id) == "payload" ? 2.0 : 1.1;
      EXPECT_EQ(taken_back_if_denied(result, found), times_as_far > most) << id << " " << times_as_far;
    }
}

TEST(Denied, WhatIsNotNamedIsLeftOutWhereUnseenRunsAreCloserWithoutIt) {
  for (const bool helps : {true, false}) {
    Told told(helps ? 1.0 : 30.0);
    told.result.effects.clear();
    SearchResult found;
    found.recalibrated.model = told.cogged.nominal;
    auto axis = told.cogged.data.axis;
    axis.effects.push_back(tests::effect("cogging", {{"amplitude_Nm", helps ? 0.01 : 0.3}, {"cycles_per_rev", 8.0}}));
    told.result.updated = axis;
    EXPECT_EQ(left_out_if_of_harm(told.result, found), !helps);
    EXPECT_EQ(told.result.updated.effects.empty(), !helps);
    told.result.unknown.emplace();  // a table
    EXPECT_EQ(left_out_if_of_harm(told.result, found), !helps);
    told.result.unknown->mode.emplace();
    EXPECT_FALSE(left_out_if_of_harm(told.result, found)) << "a part that rings is told as one that the axis holds";
  }
}

}  // namespace
}  // namespace feedtwin

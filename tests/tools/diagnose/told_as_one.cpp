// What the model keeps apart and the machine does not is told as one.

#include "tools/diagnose/told_as_one.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/tools/diagnose/named_effect.h"
#include "tools/diagnose/diagnosis_json.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;
using tests::named;

SetupFault mended(std::string id, std::string name, double value) {
  SetupFault fault;
  fault.id = std::move(id);
  fault.parameters.push_back({std::move(name), value, 1e-5});
  return fault;
}

TEST(TellAsOneLead, WhatIsLeftOfAMendedLeadsErrorIsNoSecondFinding) {
  Diagnosis result;
  result.setup.push_back(mended("wrong_lead", "factor", 2.0));
  result.effects = {named("lead_error", "relative_error", 3e-6), named("cogging", "amplitude_Nm", 0.01)};
  tell_as_one_lead(result);
  ASSERT_EQ(result.effects.size(), 1U);
  EXPECT_EQ(result.effects.front().hypothesis->id, "cogging");
  EXPECT_DOUBLE_EQ(result.setup.front().parameters.front().value, 2.0 * (1.0 + 3e-6));
}

TEST(TellAsOneCogging, WhatYieldsShowsItLaterUnderLoadAndThatIsNoRipple) {
  const auto told = [](double ripple_order, double ripple_phase_rad, double ripple_share) {
    Diagnosis result;
    result.effects = {named("cogging", "cycles_per_rev", 10.0), named("torque_ripple", "cycles_per_rev", ripple_order)};
    result.effects.front().parameters.push_back({"phase_rad", {-0.44, -0.46, -0.42}});
    result.effects.back().parameters.push_back({"phase_rad", {ripple_phase_rad, -2.1, -1.9}});
    result.effects.front().share = 0.9;
    result.effects.back().share = ripple_share;
    tell_as_one_cogging(result);
    return result.effects.size();
  };
  EXPECT_EQ(told(10.0, -1.99, 0.24), 1U);
  EXPECT_EQ(told(10.0, -1.99 + std::numbers::pi, 0.24), 1U) << "it may yield the other way round";
  EXPECT_EQ(told(12.0, -1.99, 0.24), 2U);
  EXPECT_EQ(told(10.0, -1.0, 0.24), 2U) << "not a quarter of a period away";
  EXPECT_EQ(told(10.0, -1.99, 0.6), 2U);
}

TEST(TellAsOneFrictionAlong, ASlopeAndAWaveAreOneFindingWithTheNumbersOfBoth) {
  Diagnosis result;
  result.effects = {named("position_friction", "relative_slope_per_half_stroke", 0.1),
                    named("cogging", "amplitude_Nm", 0.01), named("position_friction_wave", "period_m", 0.04)};
  result.effects.front().share = 0.2;
  result.effects.back().share = 0.5;
  tell_as_one_friction_along(result);
  ASSERT_EQ(result.effects.size(), 2U);
  const auto& told = result.effects.back();
  EXPECT_EQ(told_id(*told.hypothesis), "position_friction");
  ASSERT_EQ(told.parameters.size(), 2U);
  EXPECT_EQ(told.parameters.front().first, "period_m");
  EXPECT_EQ(told.parameters.back().first, "relative_slope_per_half_stroke");
  EXPECT_EQ(to_json(result, "")["effects"][1]["id"], "position_friction");
}

TEST(TellAsOneChange, LagsBehindSpeedAndBehindVelocityAreOneFinding) {
  Diagnosis result;
  result.effects = {named("frictional_lag", "time_constant_s", 0.002), named("cogging", "amplitude_Nm", 0.01),
                    named("frictional_lag_of_velocity", "time_constant_s", 0.02)};
  result.effects.front().share = 0.2;
  result.effects.back().share = 0.5;
  tell_as_one_change(result);
  ASSERT_EQ(result.effects.size(), 2U);
  EXPECT_EQ(result.effects.back().hypothesis->id, "frictional_lag_of_velocity");
  const auto json = to_json(result, "");
  EXPECT_EQ(json["effects"][1]["id"], "frictional_lag");
  EXPECT_DOUBLE_EQ(json["effects"][1]["parameters"]["time_constant_s"]["value"].get<double>(), 0.02);
}

TEST(TellAsOneFrictionAlong, AWaveAloneIsToldAsFrictionAlongTheStroke) {
  Diagnosis result;
  result.effects = {named("position_friction_wave", "period_m", 0.04)};
  tell_as_one_friction_along(result);
  ASSERT_EQ(result.effects.size(), 1U);
  EXPECT_EQ(to_json(result, "")["effects"][0]["id"], "position_friction");
}

TEST(TellAsOneLead, ALeadErrorWhereNoLeadWasMendedStays) {
  Diagnosis result;
  result.setup.push_back(mended("channel_skew", "delay_s", 2e-3));
  result.effects = {named("lead_error", "relative_error", 3e-4)};
  tell_as_one_lead(result);
  EXPECT_EQ(result.effects.size(), 1U);
  EXPECT_DOUBLE_EQ(result.setup.front().parameters.front().value, 2e-3);
}

NamedEffect wave(std::string_view id, double amplitude_m, double order) {
  NamedEffect effect = named(id, "amplitude_m", amplitude_m);
  effect.parameters.push_back({"cycles_per_rev", {order, order, order}});
  return effect;
}

std::size_t names_of(NamedEffect one, NamedEffect other) {
  Diagnosis result;
  result.effects = {std::move(one), std::move(other)};
  tell_as_one_wave(result);
  return result.effects.size();
}

TEST(TellAsOneWave, TheSecondHarmonicOfALeadThatWaversIsNoEncodersFault) {
  Diagnosis result;
  result.effects = {wave("encoder_eccentricity", 0.7e-6, 2.0), named("cogging", "amplitude_Nm", 0.01),
                    wave("cyclic_lead_error", 2.7e-6, 1.0)};
  tell_as_one_wave(result);
  ASSERT_EQ(result.effects.size(), 2U);
  EXPECT_EQ(result.effects[0].hypothesis->id, "cogging");
  EXPECT_EQ(result.effects[1].hypothesis->id, "cyclic_lead_error");
  EXPECT_NE(result.effects[1].sentence.find("7e-07 m come 2 times"), std::string::npos) << result.effects[1].sentence;
}

TEST(TellAsOneWave, WhatIsNoHarmonicStays) {
  EXPECT_EQ(names_of(wave("encoder_eccentricity", 2e-6, 2.0), wave("cyclic_lead_error", 2.7e-6, 1.0)), 2U) << "too large";
  EXPECT_EQ(names_of(wave("encoder_eccentricity", 1e-6, 1.0), wave("cyclic_lead_error", 2.7e-6, 1.0)), 2U);
  EXPECT_EQ(names_of(wave("encoder_eccentricity", 1e-6, 1.0), wave("cyclic_lead_error", 2.7e-6, 2.0)), 2U);
  EXPECT_EQ(names_of(named("lead_error", "relative_error", 1e-6), wave("cyclic_lead_error", 2.7e-6, 2.0)), 2U);
}

TEST(TellAsOneChange, WarmingUpAndDriftingAreOneTheOneThatExplainsMore) {
  for (const bool by_work : {true, false}) {
    Diagnosis result;
    result.effects = {named("friction_drift", "relative_change", -0.03), named("cogging", "amplitude_Nm", 0.01),
                      named("thermal_friction", "viscous_reduction", 0.2)};
    result.effects[0].share = by_work ? 0.2 : 0.7;
    result.effects[2].share = 0.6;
    tell_as_one_change(result);
    ASSERT_EQ(result.effects.size(), 2U);
    const auto& told = result.effects[by_work ? 1 : 0];
    EXPECT_EQ(told.hypothesis->id, by_work ? "thermal_friction" : "friction_drift");
    EXPECT_NE(told.sentence.find(by_work ? "friction_drift" : "thermal_friction"), std::string::npos);
  }
}

std::size_t names_beside_growth(double lead_error) {
  NamedEffect growth = named("screw_growth", "relative_growth", 6e-5);
  growth.parameters.push_back({"time_constant_s", {10.0, 10.0, 10.0}});
  Diagnosis result;
  result.effects = {std::move(growth), named("lead_error", "relative_error", lead_error)};
  tell_as_one_growth(result, 8.0);
  return result.effects.size();
}

TEST(TellAsOneGrowth, AScrewThatWasWarmHasNoWrongLeadBeside) {
  EXPECT_EQ(names_beside_growth(3e-5), 1U);
  EXPECT_EQ(names_beside_growth(-3e-5), 2U) << "shorter";
  EXPECT_EQ(names_beside_growth(2e-4), 2U) << "more than it is seen to grow";
}

}  // namespace
}  // namespace feedtwin

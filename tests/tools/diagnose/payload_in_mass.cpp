// A table that weighs half as much again as the axis file says carries something; one that is a little heavier does not.

#include "tools/diagnose/payload_in_mass.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/made_case.h"
#include "tests/tools/diagnose/fitted_runs.h"
#include "tools/diagnose/judge.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

tools::Recording run_of(const plant::AxisParameters& truth, bool sensors) {
  tests::MadeRun made{
      .motion = "sine", .duration_s = 6.0, .sensors = sensors, .torque_noise_Nm = 5e-4, .force_noise_N = 0.05};
  made.settings.speed_m_per_s = 0.15, made.settings.amplitude_m = 0.01;
  return tests::make_recording(truth, made);
}

/// What is told of a table that is so much heavier than the source's axis has it.
std::optional<NamedEffect> told(double factor, bool sensors, bool weighed = true) {
  auto truth = plant::source_axis();
  truth.guide_mass_kg *= factor;
  std::vector runs{run_of(truth, sensors)};
  if (!weighed) runs.front().channels.erase(std::string(tools::channel::force_sensor_N));
  const tests::FittedRuns fitted(runs, plant::source_axis());
  return payload_in_mass(fitted.fitter, fitted.fit, robust_covariance(fitted.model, fitted.fit));
}

TEST(PayloadInMass, IsToldWithItsSizeWhereTheForceIsRecorded) {
  const auto found = told(2.0, true);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->hypothesis->id, "payload");
  const auto& [name, mass] = found->parameters.front();
  const double more_kg = plant::source_axis().guide_mass_kg;
  EXPECT_EQ(name, "mass_kg");
  EXPECT_NEAR(mass.value, more_kg, 0.05 * more_kg);
  EXPECT_LT(mass.low, more_kg);
  EXPECT_GT(mass.high, more_kg);
  EXPECT_LT(found->p_false_alarm, 1e-6);
}

TEST(PayloadInMass, IsToldOfATableThatIsMoreThanAThirdHeavierThanAFileCanBeOff) {
  EXPECT_TRUE(told(1.45, true).has_value());
}

TEST(PayloadInMass, AForceSensorWeighsTheTableByItself) {
  EXPECT_TRUE(told(1.39, true).has_value());
  EXPECT_FALSE(told(1.39, true, false).has_value());
}

TEST(PayloadInMass, ANumberThatIsOffAsNumbersAreIsNone) {
  for (const double factor : {0.5, 0.9, 1.0, 1.1, 1.3}) EXPECT_FALSE(told(factor, true).has_value()) << factor;
}

TEST(PayloadInMass, WhatTheRecordingDoesNotSayIsNotTold) {
  EXPECT_FALSE(told(1.6, false).has_value()) << "less than a tenth of what the motor feels by itself";
}

// What swings between screw and table, and is none of the model, makes the two exchange mass.
TEST(PayloadInMass, WhatTheScrewGivesAwayTheTableDoesNotCarry) {
  const double rad_per_m = 2.0 * std::numbers::pi / plant::source_axis().axis.lead_m;
  const auto told_where_the_screw_gives = [&](double share_of_the_payload, double tables = 4.0) {
    auto truth = plant::source_axis(), nominal = truth;
    const double more_kg = tables * truth.guide_mass_kg;
    truth.guide_mass_kg += more_kg;
    nominal.ball_screw_inertia_kgm2 += share_of_the_payload * more_kg / (rad_per_m * rad_per_m);
    const std::vector runs{run_of(truth, true)};
    const tests::FittedRuns fitted(runs, nominal);
    return payload_in_mass(fitted.fitter, fitted.fit, robust_covariance(fitted.model, fitted.fit)).has_value();
  };
  EXPECT_FALSE(told_where_the_screw_gives(1.0));
  EXPECT_TRUE(told_where_the_screw_gives(0.2));
  EXPECT_TRUE(told_where_the_screw_gives(0.7, 0.8)) << "a screw's inertia may be a tenth off in the file";
}

/// Of a table that is twice as heavy as the file has it, on a screw whose friction is so many times the file's.
Diagnosis told_beside(std::vector<SetupFault> setup, double friction) {
  auto truth = plant::source_axis(), nominal = truth;
  truth.guide_mass_kg *= 2.0;
  for (auto* number : {&nominal.ball_screw.coulomb_N, &nominal.ball_screw.static_N})
    number->pos /= friction, number->neg /= friction;
  const std::vector runs{run_of(truth, true)};
  const tests::FittedRuns fitted(runs, nominal);
  Diagnosis told;
  told.setup = std::move(setup);
  tell_load(told, fitted.fitter, fitted.fit, robust_covariance(fitted.model, fitted.fit));
  return told;
}

TEST(Load, IsNotToldByAFileWhoseNumbersAreThoseOfAWrongLead) {
  const SetupFault lead{
      .id = "wrong_lead", .component = {}, .channel = {}, .sentence = "the lead is wrong.", .parameters = {}};
  const SetupFault sign{.id = "wrong_sign", .component = {}, .channel = {}, .sentence = "in reverse.", .parameters = {}};
  const auto fitted_under_it = told_beside({lead}, 0.4);
  EXPECT_TRUE(fitted_under_it.effects.empty());
  EXPECT_NE(fitted_under_it.setup.front().sentence, lead.sentence) << "why there is none is told";
  for (const auto& told : {told_beside({lead}, 1.1), told_beside({sign}, 0.4), told_beside({}, 0.4)}) {
    ASSERT_EQ(told.effects.size(), 1U);
    EXPECT_EQ(told.effects.front().hypothesis->id, "payload");
  }
}

}  // namespace
}  // namespace feedtwin

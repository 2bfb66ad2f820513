// A table that weighs half as much again as the axis file says carries something; one that is a little heavier does not.

#include "tools/diagnose/payload_in_mass.h"

#include <gtest/gtest.h>

#include "tests/support/made_case.h"
#include "tests/tools/diagnose/fitted_runs.h"
#include "tools/diagnose/judge.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

/// What is told of a table that is so much heavier than the source's axis has it.
std::optional<NamedEffect> told(double factor, bool sensors) {
  auto truth = plant::source_axis();
  truth.guide_mass_kg *= factor;
  tests::MadeRun made{
      .motion = "sine", .duration_s = 6.0, .sensors = sensors, .torque_noise_Nm = 5e-4, .force_noise_N = 0.05};
  made.settings.speed_m_per_s = 0.15, made.settings.amplitude_m = 0.01;
  const std::vector runs{tests::make_recording(truth, made)};
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

TEST(PayloadInMass, ANumberThatIsOffAsNumbersAreIsNone) {
  for (const double factor : {0.5, 0.9, 1.0, 1.1, 1.3}) EXPECT_FALSE(told(factor, true).has_value()) << factor;
}

TEST(PayloadInMass, WhatTheRecordingDoesNotSayIsNotTold) {
  EXPECT_FALSE(told(1.6, false).has_value()) << "less than a tenth of what the motor feels by itself";
}

}  // namespace
}  // namespace feedtwin

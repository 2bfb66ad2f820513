// A screw whose stiffness only the force sensor shows is not called a late sensor, and a rigid one is left alone.

#include "tools/diagnose/forward/stiffness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "tests/support/made_case.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

struct AskedHowStiff {
  SearchResult found;
  Fit fit;
  std::optional<Ruling> settled;
};

/// An axis with these effects, recorded with force and torque sensors and without a scale (unless one is asked for), where
/// the search named late sensors. @param rounds of fitting their delays and the nominal numbers; 0: as given
AskedHowStiff asked_of(const std::vector<plant::EffectSetting>& effects, const std::vector<double>& late_s, int rounds,
                       bool scale = false) {
  auto truth = plant::source_axis();
  truth.effects = effects;
  tools::Case data = tests::short_case(truth, plant::source_axis());
  tests::MadeRun run{
      .motion = "s_curve", .duration_s = 3.0, .scale_at_table = scale, .torque_noise_Nm = 5e-4, .force_noise_N = 0.05};
  run.settings = {.amplitude_m = 0.02, .speed_m_per_s = 0.1, .acceleration_m_per_s2 = 8.0, .jerk_m_per_s3 = 2000.0};
  data.fit = {tests::make_recording(truth, run)};
  if (!scale)
    for (auto& recording : data.fit) recording.channels.erase("scale_position_m");
  const InverseModel model(make_tracks(data.fit, data.axis), data.axis);
  const Fitter fitter(model, data.axis);
  const Active late{&hypothesis("channel_skew"), late_s};
  AskedHowStiff asked;
  asked.found.whitening = fitter.colour_of(model.residual(data.axis, {}));
  asked.fit = fitter.fit_with_colour({data.axis, {late}}, asked.found.whitening, rounds, 6);
  asked.found.found.emplace_back();
  asked.found.found.back().effect = asked.fit.model.effects.front();
  const ForwardModel forward(data.fit, data);
  asked.settled = ask_how_stiff(forward, fitter, asked.found, asked.fit, [](std::string_view) {});
  return asked;
}

TEST(AskHowStiff, AScrewThatYieldsIsNoLateSensor) {
  const auto asked = asked_of({tests::effect("screw_compliance", {{"stiffness_N_per_m", 1.7e8}})}, {0.0, 3e-4}, 2);
  EXPECT_TRUE(asked.found.found.empty());
  ASSERT_EQ(asked.fit.model.effects.size(), 1U);
  EXPECT_EQ(asked.fit.model.effects[0].hypothesis->id, "screw_compliance");
  EXPECT_NEAR(1.0 / asked.fit.model.effects[0].q[0], 1.7e8, 0.03 * 1.7e8);
  EXPECT_FALSE(worth_naming(asked.fit.model.effects[0], asked.fit.model.axis));
  ASSERT_TRUE(asked.settled.has_value());
  EXPECT_EQ(asked.settled->model.effects.size(), 1U);
}

TEST(AskHowStiff, StartsFromTheComplianceThatAScaleShows) {
  const auto asked = asked_of({tests::effect("screw_compliance", {{"stiffness_N_per_m", 3.2e8}})}, {0.0, 3e-4}, 2, true);
  ASSERT_EQ(asked.fit.model.effects.size(), 1U);
  EXPECT_EQ(asked.fit.model.effects[0].hypothesis->id, "screw_compliance");
  EXPECT_NEAR(1.0 / asked.fit.model.effects[0].q[0], 3.2e8, 0.03 * 3.2e8);
}

TEST(AskHowStiff, ALateTorqueSensorStaysLateOnAScrewThatYields) {
  const auto asked = asked_of({tests::effect("screw_compliance", {{"stiffness_N_per_m", 1.7e8}}),
                               tests::effect("channel_skew", {{"torque_sensor_delay_s", 4e-3}})},
                              {3.9e-3, 1.4e-3}, 0);
  ASSERT_EQ(asked.found.found.size(), 1U);
  ASSERT_EQ(asked.fit.model.effects.size(), 2U);
  EXPECT_NEAR(asked.fit.model.effects[0].q[0], 4e-3, 1e-4);
  EXPECT_NEAR(asked.fit.model.effects[0].q[1], 0.0, 2e-4);
  EXPECT_EQ(asked.fit.model.effects[1].hypothesis->id, "screw_compliance");
}

TEST(AskHowStiff, ALateSensorOnARigidScrewStaysLate) {
  const auto asked = asked_of({tests::effect("channel_skew", {{"force_sensor_delay_s", 1.4e-3}})}, {0.0, 3e-4}, 2);
  ASSERT_EQ(asked.found.found.size(), 1U);
  ASSERT_EQ(asked.fit.model.effects.size(), 1U);
  EXPECT_EQ(asked.fit.model.effects[0].hypothesis->id, "channel_skew");
  EXPECT_NEAR(asked.fit.model.effects[0].q[1], 1.4e-3, 1e-4);
}

// Polished effects beside numbers that were not are no model: one that lets the screw slide too early lost a copper loss.
TEST(AskHowStiff, WhatTheFitHoldsBesideTheStiffnessStaysAsItWasFitted) {
  auto truth = plant::source_axis(), nominal = truth;
  truth.effects = {tests::effect("screw_compliance", {{"stiffness_N_per_m", 1.7e8}}),
                   tests::effect("torque_offset", {{"offset_Nm", 0.01}})};
  nominal.ball_screw.coulomb_N.pos *= 1.05;
  tools::Case data = tests::short_case(truth, nominal);
  tests::MadeRun run{.motion = "s_curve", .duration_s = 3.0, .torque_noise_Nm = 5e-4, .force_noise_N = 0.05};
  run.settings = {.amplitude_m = 0.02, .speed_m_per_s = 0.1, .acceleration_m_per_s2 = 8.0, .jerk_m_per_s3 = 2000.0};
  data.fit = {tests::make_recording(truth, run)};
  data.fit[0].channels.erase("scale_position_m");
  const InverseModel model(make_tracks(data.fit, nominal), nominal);
  const Fitter fitter(model, nominal);
  SearchResult found;
  found.whitening = fitter.colour_of(model.residual(nominal, {}));
  Fit fit = fitter.fit_with_colour({nominal, {{&hypothesis("torque_offset"), {0.0}}}}, found.whitening, 2, 6);
  const Candidate before = fit.model;
  const ForwardModel forward(data.fit, data);
  ASSERT_TRUE(ask_how_stiff(forward, fitter, found, fit, [](std::string_view) {}).has_value());
  ASSERT_EQ(fit.model.effects.size(), 2U) << "a screw that yields";
  EXPECT_EQ(fit.model.effects[0].q, before.effects[0].q);
  EXPECT_EQ(fit.model.axis.ball_screw.coulomb_N.pos, before.axis.ball_screw.coulomb_N.pos);
}

/// The same by its torque sensor alone, on a table as heavy as motor and screw. @param named by the search
/// @return compliance, m/N; 0: taken for rigid
double compliance_by_torque_sensor(const std::vector<plant::EffectSetting>& effects, std::vector<Active> named = {}) {
  auto truth = plant::source_axis(), nominal = truth;
  truth.guide_mass_kg = nominal.guide_mass_kg = 90.0;
  truth.effects = effects;
  tools::Case data = tests::short_case(truth, nominal);
  tests::MadeRun run{.motion = "s_curve", .duration_s = 3.0, .torque_noise_Nm = 5e-4};
  run.settings = {.amplitude_m = 0.02, .speed_m_per_s = 0.1, .acceleration_m_per_s2 = 8.0, .jerk_m_per_s3 = 2000.0};
  data.fit = {tests::make_recording(truth, run)};
  for (const char* other : {"scale_position_m", "force_sensor_N"}) data.fit[0].channels.erase(other);
  const InverseModel model(make_tracks(data.fit, nominal), nominal);
  const Fitter fitter(model, nominal);
  SearchResult found;
  found.whitening = fitter.colour_of(model.residual(nominal, {}));
  Fit fit = fitter.fit_with_colour({nominal, std::move(named)}, found.whitening, 2, 6);
  const ForwardModel forward(data.fit, data);
  (void)ask_how_stiff(forward, fitter, found, fit, [](std::string_view) {});
  const auto screw = std::ranges::find(fit.model.effects, &hypothesis("screw_compliance"), &Active::hypothesis);
  return screw == fit.model.effects.end() ? 0.0 : screw->q[0];
}

TEST(AskHowStiff, ByTheTorqueSensorAlone) {
  const double compliance = compliance_by_torque_sensor(
      {tests::effect("screw_compliance", {{"stiffness_N_per_m", 1.3e8}, {"damping_Ns_per_m", 1.5e4}})});
  EXPECT_NEAR(1.0 / compliance, 1.3e8, 0.05 * 1.3e8);
}

TEST(AskHowStiff, ARigidHeavyTableAndALaggingDriveAreNoYieldingScrew) {
  EXPECT_EQ(compliance_by_torque_sensor({}), 0.0);
  EXPECT_EQ(compliance_by_torque_sensor({tests::effect("input_delay", {{"delay_s", 1.5e-3}})},
                                        {{&hypothesis("input_delay"), {1.4e-3}}}),
            0.0);
}

}  // namespace
}  // namespace feedtwin

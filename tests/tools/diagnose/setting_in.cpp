// A motor whose friction sets in over a path is given to the model where a torque sensor shows it, and only there.

#include "tools/diagnose/forward/setting_in.h"
#include "tools/diagnose/motor_friction.h"

#include <gtest/gtest.h>

#include <utility>

#include "tests/support/made_case.h"
#include "tools/diagnose/forward/extended_axis.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

plant::AxisParameters axis_over(double distance_m) {
  auto axis = plant::source_axis();
  if (distance_m > 0.0) axis.effects = {tests::effect("motor_presliding", {{"distance_m", distance_m}})};
  return axis;
}

/// A run of the truth and both engines on it.
struct Made {
  tools::Case data;
  InverseModel model;
  Fitter fitter;
  ForwardModel forward;
  Whitening whitening;

  Made(const plant::AxisParameters& truth, const plant::AxisParameters& nominal, bool torque_sensor = true,
       double torque_noise_Nm = 5e-4)
      : data(recorded(truth, nominal, torque_sensor, torque_noise_Nm)),
        model(make_tracks(data.fit, data.axis), data.axis),
        fitter(model, data.axis),
        forward(data.fit, data),
        whitening(fitter.colour_of(model.residual(data.axis, {}))) {}

  static tools::Case recorded(const plant::AxisParameters& truth, const plant::AxisParameters& nominal, bool torque_sensor,
                              double torque_noise_Nm) {
    tools::Case data = tests::short_case(truth, nominal);
    tests::MadeRun run{.duration_s = 3.0, .torque_noise_Nm = torque_noise_Nm, .force_noise_N = 0.05};
    run.settings = {.amplitude_m = 0.01, .speed_m_per_s = 0.06};
    data.fit = {tests::make_recording(truth, run)};
    if (!torque_sensor) data.fit.front().channels.erase("torque_sensor_Nm");
    return data;
  }
};

struct SetsIn {
  double in_fit_m, in_recalibrated_m;
  std::optional<Ruling> settled;
};

SetsIn asked_of(double truth_m, bool torque_sensor) {
  auto nominal = plant::source_axis();
  nominal.motor.coulomb_N.pos *= 0.95;
  const Made made(axis_over(truth_m), nominal, torque_sensor);
  SearchResult found;
  found.whitening = made.whitening;
  Fit fit = made.fitter.fit_with_colour({nominal, {}}, found.whitening, 2, 6);
  found.recalibrated = fit;
  auto settled = ask_how_motor_sets_in(made.forward, made.fitter, found, fit, std::nullopt, [](std::string_view) {});
  return {motor_presliding_m(fit.model.axis), motor_presliding_m(found.recalibrated.model.axis), std::move(settled)};
}

TEST(AskHowMotorSetsIn, OverThePathThatItHas) {
  const auto asked = asked_of(1e-6, true);
  EXPECT_EQ(asked.in_fit_m, 1e-6);
  EXPECT_EQ(asked.in_recalibrated_m, 1e-6);
  ASSERT_TRUE(asked.settled.has_value());
  EXPECT_EQ(motor_presliding_m(asked.settled->model.axis), 1e-6);
  // with it the motor's share of the friction is the true one again
  EXPECT_NEAR(asked.settled->model.axis.motor.coulomb_N.pos, plant::source_axis().motor.coulomb_N.pos, 0.5);
}

TEST(AskHowMotorSetsIn, AtOnceWhereItDoes) {
  EXPECT_EQ(asked_of(0.0, true).in_fit_m, 0.0);
}

TEST(AskHowMotorSetsIn, NotWhereTheCommandAloneShowsIt) {
  const auto asked = asked_of(1e-6, false);
  EXPECT_EQ(asked.in_fit_m, 0.0);
  EXPECT_FALSE(asked.settled.has_value());
}

// The numbers of an explanation beside it are taken over, not how its motor sets in.
TEST(AskHowMotorSetsIn, WhatIsGivenOutlivesTheNumbersOfAnother) {
  const auto truth = axis_over(1e-6);
  const Made made(truth, truth);
  Candidate far_off{truth, {}}, at_once{truth, {}};
  far_off.axis.ball_screw.coulomb_N = {60.0, 55.0};
  at_once.axis.effects.clear();
  const Ruling before{
      made.fitter.linearised(at_once, made.whitening), at_once, likelihood(made.forward, extended(at_once)), 0.0, {}};
  const Fit fit = made.fitter.linearised(far_off, made.whitening);
  const Ruling beside = rule_beside(before, fit, made.forward, made.fitter, SlopesOf::anew);
  EXPECT_EQ(motor_presliding_m(beside.model.axis), 1e-6);
}

double before_any_name_m(double truth_m, bool torque_sensor) {
  auto nominal = plant::source_axis();
  nominal.motor.coulomb_N.pos *= 0.95;
  const Made made(axis_over(truth_m), nominal, torque_sensor, 5e-5);
  auto axis = nominal;
  axis.effects = motor_as_it_sets_in(made.forward, made.fitter, [](std::string_view) {});
  return motor_presliding_m(axis);
}

TEST(MotorAsItSetsIn, IsKnownBeforeAnyName) {
  const double found_m = before_any_name_m(1e-6, true);
  EXPECT_GE(found_m, 7e-7);
  EXPECT_LE(found_m, 1.4e-6);
  EXPECT_EQ(before_any_name_m(0.0, true), 0.0);
  EXPECT_EQ(before_any_name_m(1e-6, false), 0.0) << "the command shows only what motor and screw do together";
}

}  // namespace
}  // namespace feedtwin

// A motor whose friction sets in over a path is given to the model where a torque sensor shows it, and only there.

#include <gtest/gtest.h>

#include "tests/support/made_case.h"
#include "tools/diagnose/forward/setting_in.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

struct Asked {
  double in_fit_m, in_recalibrated_m;
  std::optional<Ruling> settled;
};

Asked asked_of(double truth_m, bool torque_sensor) {
  auto truth = plant::source_axis();
  if (truth_m > 0.0) truth.effects = {tests::effect("motor_presliding", {{"distance_m", truth_m}})};
  auto nominal = plant::source_axis();
  nominal.motor.coulomb_N.pos *= 0.95;
  tools::Case data = tests::short_case(truth, nominal);
  tests::MadeRun run{.duration_s = 3.0, .torque_noise_Nm = 5e-4, .force_noise_N = 0.05};
  run.settings = {.amplitude_m = 0.01, .speed_m_per_s = 0.06};
  data.fit = {tests::make_recording(truth, run)};
  if (!torque_sensor) data.fit.front().channels.erase("torque_sensor_Nm");
  const InverseModel model(make_tracks(data.fit, data.axis), data.axis);
  const Fitter fitter(model, data.axis);
  SearchResult found;
  found.whitening = fitter.colour_of(model.residual(data.axis, {}));
  Fit fit = fitter.fit_with_colour({data.axis, {}}, found.whitening, 2, 6);
  found.recalibrated = fit;
  const ForwardModel forward(data.fit, data);
  auto settled = ask_how_motor_sets_in(forward, fitter, found, fit, std::nullopt, [](std::string_view) {});
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

}  // namespace
}  // namespace feedtwin

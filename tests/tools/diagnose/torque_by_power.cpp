// What the power alone tells of the torque constant, and what it says of one that the forces asked for.

#include "tools/diagnose/torque_by_power.h"

#include <gtest/gtest.h>

#include "tests/support/made_case.h"
#include "tools/diagnose/hypotheses/registry.h"
#include "tools/recording/power_meter.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

struct TorqueByPowerOf : testing::Test {
  static tools::Case made(double relative_error) {
    auto truth = plant::source_axis();
    truth.effects.push_back(tests::effect("torque_gain_error", {{"relative_error", relative_error}}));
    truth.ball_screw.coulomb_N.pos *= 1.3;  // friction that is not the model's has no say
    tools::Case data;
    data.axis = plant::source_axis();
    for (const double speed : {0.05, 0.12, 0.2})
      data.fit.push_back(tests::make_recording(
          truth,
          {.motion = "s_curve", .settings = {.speed_m_per_s = speed, .acceleration_m_per_s2 = 4.0}, .duration_s = 6.0}));
    for (auto& run : data.fit) run.meter = tools::meter_habit(data.fit, data.axis);
    return data;
  }
  static Candidate with(const tools::Case& data, double relative_error) {
    return {data.axis, {{&hypothesis("torque_gain_error"), {relative_error}}}};
  }
};

TEST_F(TorqueByPowerOf, IsWhatTheMotorGivesWhateverFrictionIs) {
  for (const double true_error : {-0.1, 0.02, 0.06}) {
    const auto data = made(true_error);
    const InverseModel model(make_tracks(data.fit, data.axis), data.axis);
    const Fitter fitter(model, data.axis);
    const auto found = torque_by_power(fitter, {data.axis, {}});
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->relative_error, true_error, 0.005);
    EXPECT_LT(found->deviation, 0.005);
  }
}

TEST_F(TorqueByPowerOf, DeniesOnlyAnErrorThatIsNotThePowers) {
  const auto data = made(-0.1);
  const InverseModel model(make_tracks(data.fit, data.axis), data.axis);
  const Fitter fitter(model, data.axis);
  EXPECT_FALSE(denied_by_power(fitter, with(data, -0.1), 0));
  EXPECT_FALSE(denied_by_power(fitter, with(data, -0.12), 0));
  EXPECT_TRUE(denied_by_power(fitter, with(data, -0.05), 0));
  EXPECT_TRUE(denied_by_power(fitter, with(data, 0.1), 0));
  const Candidate other{data.axis, {{&hypothesis("torque_offset"), {0.1}}}};
  EXPECT_FALSE(denied_by_power(fitter, other, 0)) << "of no other name does it say anything";
}

TEST_F(TorqueByPowerOf, SaysNothingWithoutAPower) {
  auto data = made(-0.1);
  for (auto& run : data.fit) run.channels.erase("power_W");
  const InverseModel model(make_tracks(data.fit, data.axis), data.axis);
  const Fitter fitter(model, data.axis);
  EXPECT_FALSE(torque_by_power(fitter, {data.axis, {}}));
  EXPECT_FALSE(denied_by_power(fitter, with(data, 0.1), 0));
}

}  // namespace
}  // namespace feedtwin

#include "tools/identify/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/made_case.h"
#include "tools/identify/component_energy.h"

namespace feedtwin::tools {
namespace {

TEST(ChannelMetrics, FollowTheirDefinitions) {
  const std::vector<double> y{1.0, 2.0, 4.0, 3.0}, s{1.0, 2.5, 3.0, 3.0};
  const auto m = channel_metrics(y, s, 0.0);
  EXPECT_DOUBLE_EQ(m.peak, 1.0);
  EXPECT_DOUBLE_EQ(m.rms, std::sqrt(1.25 / 4.0));
  EXPECT_DOUBLE_EQ(m.rel_error, std::sqrt(1.25 / 30.0));
  EXPECT_DOUBLE_EQ(m.nrmse, std::sqrt(1.25 / 5.0));
}

TEST(ChannelMetrics, SeeADelay) {
  std::vector<double> y, s;
  for (int i = 0; i < 4000; ++i) {
    y.push_back(std::sin(0.01 * i));
    s.push_back(std::sin(0.01 * (i - 2.5)));
  }
  EXPECT_NEAR(channel_metrics(y, s, 1e-3).delay_s, 2.5e-3, 1e-5);
}

TEST(ChannelMetrics, PooledRunsAreAsOneLongRun) {
  std::mt19937 random(41);
  std::normal_distribution<double> unit;
  std::vector<double> y, s;
  for (int i = 0; i < 1000; ++i) {
    y.push_back(unit(random));
    s.push_back(y.back() + 0.1 * unit(random));
  }
  const std::span all_y(y), all_s(s);
  const ChannelMetrics parts[] = {channel_metrics(all_y.first(300), all_s.first(300), 1e-3),
                                  channel_metrics(all_y.subspan(300), all_s.subspan(300), 1e-3)};
  const auto whole = channel_metrics(y, s, 1e-3), together = pooled(parts);
  EXPECT_NEAR(together.rms, whole.rms, 1e-12);
  EXPECT_NEAR(together.rel_error, whole.rel_error, 1e-12);
  EXPECT_EQ(together.peak, whole.peak);
}

// The sensors' account against the plant's own: components, and their sum is the work of the motor.
TEST(ComponentEnergy, AddsUpToTheWorkPutIn) {
  const auto axis = plant::source_axis();
  const auto r = tests::make_recording(axis, {.settings = {.amplitude_m = 0.02, .speed_m_per_s = 0.05}, .duration_s = 3.0});
  const auto e = component_energy({r.at("torque_cmd_Nm"), r.at("position_m"), r.at("torque_sensor_Nm"),
                                   r.at("force_sensor_N"), r.at("power_W"), axis.axis.lead_m, 1e-3});
  EXPECT_NEAR(*e.motor_mechanical_J + *e.ball_screw_J + *e.guide_J, e.input_work_J, 1e-9 * e.input_work_J);
  EXPECT_GT(*e.ball_screw_J, 2.0 * *e.motor_mechanical_J);
  EXPECT_GT(*e.motor_mechanical_J, 2.0 * *e.guide_J);
  EXPECT_FALSE(component_energy({r.at("torque_cmd_Nm"), r.at("position_m"), {}, {}, {}, axis.axis.lead_m, 1e-3})
                   .ball_screw_J.has_value());
}

}  // namespace
}  // namespace feedtwin::tools

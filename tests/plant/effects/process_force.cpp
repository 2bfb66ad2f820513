// A process that cuts in a part of the time.

#include "plant/effects/process_force.h"

#include <gtest/gtest.h>

#include "tests/support/smooth_axis.h"

namespace feedtwin::plant {
namespace {

/// After days in the cut too, where the difference of two times is no measure of an instant.
TEST(ProcessForce, CutsFromItsStartToItsEnd) {
  constexpr double start_s = 1e6 + 0.25e-3, end_s = 2e6;
  const effects::ProcessForce process({test::smooth_axis(), make_axis_model(test::smooth_axis())},
                                      {"process_force", {20.0, 0.0, 70.0, 0.0, start_s, end_s, 12.0, 0.0}, {}});
  const auto load_N = [&](double time_s, double h_s) {
    return process
        .load({.position_m = 0.0,
               .velocity_m_per_s = -0.1,
               .sign = -1.0,
               .acceleration_m_per_s2 = 0.0,
               .torque_Nm = 0.0,
               .table_load_N = 0.0,
               .h_s = h_s,
               .time_s = time_s,
               .tick_phase_s = 0.0})
        .force_N;
  };
  EXPECT_EQ(load_N(1e6 - 1.0, 1e-3), 0.0);
  EXPECT_NEAR(load_N(1e6, 1e-3), 0.75 * 8.0, 1e-5);
  EXPECT_EQ(load_N(1.5e6, 1e-3), 8.0);
  EXPECT_EQ(load_N(1.5e6, 1e-9), 8.0);
  EXPECT_EQ(load_N(end_s, 1e-9), 0.0);
}

constexpr double opposing_N = 20.0, amplitude_N = 8.0, frequency_Hz = 50.0;
constexpr double crest_s = 0.25 / frequency_Hz, trough_s = 0.75 / frequency_Hz;

EffectLoad load_in_workpiece(double position_m, double velocity_m_per_s, double time_s, double only_direction = 0.0) {
  const effects::ProcessForceAgainstMotion process(
      {test::smooth_axis(), make_axis_model(test::smooth_axis())},
      {"process_force_against_motion", {opposing_N, amplitude_N, frequency_Hz, 0.0, -0.01, 0.02, only_direction}, {}});
  return process.load({.position_m = position_m,
                       .velocity_m_per_s = velocity_m_per_s,
                       .sign = velocity_m_per_s < 0.0 ? -1.0 : 1.0,
                       .acceleration_m_per_s2 = 0.0,
                       .torque_Nm = 0.0,
                       .table_load_N = 0.0,
                       .h_s = 1e-6,
                       .time_s = time_s,
                       .tick_phase_s = 0.0});
}

/// Both ways through a workpiece that lies between two places, and nowhere else.
TEST(ProcessForceAgainstMotion, OpposesTheMotionTeethAndAllInTheWorkpiece) {
  const auto load = [](double position_m, double v, double time_s) { return load_in_workpiece(position_m, v, time_s); };
  for (const double v : {0.1, -0.1}) {
    const double way = v < 0.0 ? -1.0 : 1.0;
    EXPECT_NEAR(load(0.0, v, crest_s).force_N, way * (opposing_N + amplitude_N), 1e-3);
    EXPECT_NEAR(load(0.0, v, trough_s).force_N, way * (opposing_N - amplitude_N), 1e-3);
    for (const double outside_m : {-0.011, 0.021}) EXPECT_EQ(load(outside_m, v, crest_s).force_N, 0.0);
  }
  const double slope = (load(0.0, 1e-4, crest_s).force_N - load(0.0, 0.9e-4, crest_s).force_N) / 1e-5;
  EXPECT_NEAR(load(0.0, 0.95e-4, crest_s).slope_Ns_per_m, slope, 1e-3 * slope);
}

TEST(ProcessForceAgainstMotion, MayCutOneWayAndComeBackInTheAir) {
  for (const double only : {1.0, -1.0}) {
    const auto force_N = [&](double v) { return load_in_workpiece(0.0, v, crest_s, only).force_N; };
    EXPECT_NEAR(force_N(only * 0.1), only * (opposing_N + amplitude_N), 1e-3);
    EXPECT_NEAR(force_N(-only * 0.1), 0.0, 1e-3);
    const double v = only * 1e-4, slope = (force_N(1.05 * v) - force_N(0.95 * v)) / (0.1 * v);
    EXPECT_NEAR(load_in_workpiece(0.0, v, crest_s, only).slope_Ns_per_m, slope, 1e-3 * slope);
  }
}

}  // namespace
}  // namespace feedtwin::plant

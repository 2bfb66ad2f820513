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

}  // namespace
}  // namespace feedtwin::plant

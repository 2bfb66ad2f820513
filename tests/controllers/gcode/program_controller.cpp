#include "controllers/gcode/program_controller.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "controllers/gcode/contour_error.h"
#include "controllers/gcode/interpreter.h"
#include "controllers/gcode/planner.h"

namespace feedtwin::controllers::gcode {
namespace {

constexpr plant::BlockParameters block{-0.05, 0.05, -0.05, 0.05, 0.0};

Trajectory trajectory_of(const char* text) {
  return plan(interpret(text), {});
}

TEST(EngagementMap, FullImmersionInASlotHalfOnTheWayBackNothingTwice) {
  const auto trajectory = trajectory_of("F600 G1 Z-1\nX20\nY2\nX0\nX20\nM2");
  const EngagementMap map(trajectory, block, 2e-3);
  EXPECT_FALSE(map.at(0, 0.5e-3).cutting()) << "a plunge";
  EXPECT_NEAR(map.at(1, 0.01).immersions[0].exit_rad, std::numbers::pi, 1e-6);
  const auto back = map.at(3, 0.01);  // two of four millimetres, to the right of a feed towards -x
  ASSERT_EQ(back.count, 1);
  EXPECT_NEAR(back.immersions[0].exit_rad - back.immersions[0].entry_rad, std::numbers::pi / 2, 1e-3);
  EXPECT_NEAR(back.immersions[0].exit_rad, std::numbers::pi, 1e-6);
  EXPECT_FALSE(map.at(4, 0.01).cutting());
  EXPECT_FALSE(map.at(99, 0.0).cutting()) << "no such move";
}

TEST(EngagementMap, VolumeOfARingSlotIsItsGeometry) {
  const auto trajectory = trajectory_of("F600 G1 Z-1\nG2 I10\nM2");
  const EngagementMap map(trajectory, block, 2e-3);
  const double ring = 2 * std::numbers::pi * 10e-3 * 4e-3 * 1e-3, plunge = std::numbers::pi * 4e-6 * 1e-3;
  EXPECT_NEAR((map.volume_m3() + plunge) / ring, 1.0, 5e-3);
}

TEST(ContourError, IsTheDistanceFromThePath) {
  const auto trajectory = trajectory_of("F600 G1 X10\nG3 X20 Y10 J10\nM2");
  const auto& s = trajectory.segments();
  EXPECT_NEAR(planar_distance_m(s[0], 5e-3, 3e-6), 3e-6, 1e-15);
  EXPECT_NEAR(planar_distance_m(s[0], -3e-6, 4e-6), 5e-6, 1e-15);
  const double angle = -0.3;
  EXPECT_NEAR(planar_distance_m(s[1], 10e-3 + 10.002e-3 * std::cos(angle), 10e-3 + 10.002e-3 * std::sin(angle)), 2e-6,
              1e-12);
  EXPECT_NEAR(contour_error_m(s, 1, 9e-3, 1e-6), 1e-6, 1e-12) << "behind a corner, still on the move before";
}

TEST(ProgramController, SwitchesOnTimeAndTracksAnIdealTable) {
  Trajectory trajectory = trajectory_of("S600 M3 M8\nF600 G1 X10\nM9\nG4 P0.2\nM5\nG1 X0\nM2");
  EngagementMap map(trajectory, block, 2e-3);
  ProgramController controller(std::move(trajectory), std::move(map), {}, {}, 1.5);
  double x = 0.0;
  bool pump_seen = false, off_seen = false;
  while (!controller.finished()) {
    const auto& command = controller.step(x, 0.0, 1e-3);
    x = controller.setpoint().at_m.x;
    if (controller.setpoint().moving && x > 5e-3 && command.pump) pump_seen = true;
    if (command.spindle_speed_rad_per_s == 0.0 && controller.time_s() > 1.2) off_seen = true;
    if (controller.time_s() < 0.5) {
      EXPECT_NEAR(command.spindle_speed_rad_per_s, 1.5 * 20 * std::numbers::pi, 1e-9);
    }
  }
  EXPECT_TRUE(pump_seen && off_seen);
  EXPECT_NEAR(x, 0.0, 1e-6);
}

}  // namespace
}  // namespace feedtwin::controllers::gcode

#include "rt/quick_stop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "plant/parameter_table.h"
#include "tests/support/random_axis.h"

namespace feedtwin::rt {
namespace {

struct Stop {
  double time_s = 0.0, way_m = 0.0, most_Nm = 0.0, back_m_per_s = 0.0;
};

/// Ticks until the axis stands, within 1 s.
Stop stop_from(plant::FeedAxis& axis, double velocity_m_per_s, const io::AxisRequest& request, bool coasting = false,
               double tick_s = 1e-3) {
  axis.place(0.0, velocity_m_per_s);
  // the speed shows after a tick
  axis.step({}, tick_s);
  const double began_m = axis.signals().position_m;
  QuickStop quick_stop;
  quick_stop.idle();
  Stop stop;
  while (std::abs(axis.signals().velocity_m_per_s) > 1e-5 && stop.time_s < 1.0) {
    const double torque_Nm = coasting ? 0.0 : quick_stop.torque_Nm(axis, request, tick_s);
    EXPECT_LE(torque_Nm * axis.signals().velocity_m_per_s, 0.0) << "it drives";
    axis.step({.torque_Nm = torque_Nm}, tick_s);
    stop.most_Nm = std::max(stop.most_Nm, std::abs(torque_Nm));
    stop.time_s += tick_s;
    stop.back_m_per_s =
        std::max(stop.back_m_per_s, -axis.signals().velocity_m_per_s * (velocity_m_per_s > 0.0 ? 1.0 : -1.0));
  }
  stop.way_m = std::abs(axis.signals().position_m - began_m);
  return stop;
}

TEST(QuickStop, RatedTorqueBringsTheSourcesAxisToRestWithinItsKineticEnergy) {
  plant::FeedAxis axis(plant::source_axis());
  for (const double velocity : {0.2, -0.2, 0.05, 0.003}) {
    const Stop stop = stop_from(axis, velocity, {});
    const Stop coasted = stop_from(axis, velocity, {}, true);
    const double brake_N = axis.parameters().motor.rated_torque_Nm * axis.model().transmission_rad_per_m;
    const double most_m = 0.5 * axis.model().mass_kg * velocity * velocity / brake_N;  // friction only helps
    EXPECT_LE(stop.most_Nm, axis.parameters().motor.rated_torque_Nm);
    EXPECT_LT(stop.way_m, most_m + 5e-3 * std::abs(velocity)) << velocity;  // and five ticks for the loop to settle
    EXPECT_LE(stop.way_m, coasted.way_m) << velocity;
    EXPECT_LT(stop.back_m_per_s, 1e-3) << "swings back";
    if (std::abs(velocity) > 0.1) {
      EXPECT_LT(stop.way_m, 0.3 * coasted.way_m);
    }
  }
}

TEST(QuickStop, FollowsTheRampWhereItIsSteeperThanFriction) {
  plant::FeedAxis axis(plant::source_axis());
  for (const double ramp : {9.81, 12.0, 15.0}) {  // friction alone makes 8 m/s^2 at this speed
    const Stop stop = stop_from(axis, 0.25, {.brake_m_per_s2 = ramp}, false, 0.25e-3);
    EXPECT_NEAR(stop.way_m, 0.5 * 0.25 * 0.25 / ramp, 0.1 * 0.5 * 0.25 * 0.25 / ramp) << ramp;
  }
  // less steep: friction alone
  const Stop gentle = stop_from(axis, 0.25, {.brake_m_per_s2 = 0.05});
  const Stop coasted = stop_from(axis, 0.25, {}, true);
  EXPECT_NEAR(gentle.way_m, coasted.way_m, 0.01 * coasted.way_m);
}

TEST(QuickStop, KeepsToItsTorque) {
  plant::FeedAxis axis(plant::source_axis());
  EXPECT_DOUBLE_EQ(stop_from(axis, 0.2, {.brake_limit_Nm = 0.3}).most_Nm, 0.3);
  EXPECT_DOUBLE_EQ(stop_from(axis, 0.2, {.brake_limit_Nm = 0.0}).most_Nm, 0.0);
  EXPECT_DOUBLE_EQ(stop_from(axis, 0.2, {.brake_limit_Nm = 50.0}).most_Nm, axis.parameters().axis.torque_limit_Nm);
}

TEST(QuickStop, StopsAnyAxisAndNeverDrivesIt) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    std::mt19937_64 random(seed);
    plant::FeedAxis axis(tests::axis_near_source(random, 2.0));
    std::uniform_real_distribution<double> speed(-0.3, 0.3);
    const Stop stop = stop_from(axis, speed(random), {.brake_m_per_s2 = seed % 2 == 0 ? 5.0 : 0.0});
    ASSERT_LT(stop.time_s, 1.0) << "seed " << seed;
  }
}

}  // namespace
}  // namespace feedtwin::rt

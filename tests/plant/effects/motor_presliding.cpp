// The motor's bristle against an independent integration, and at speed against Coulomb friction that sets in at once.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "plant/feed_axis.h"
#include "tests/support/smooth_axis.h"
#include "tests/support/tick.h"

namespace feedtwin::plant {
namespace {

using test::tick_s;

constexpr Directional coulomb_N{30.0, 15.0};
constexpr double gone_m = 2e-6;

AxisParameters axis_over(double over_m) {
  auto axis = test::smooth_axis();
  axis.motor.coulomb_N = coulomb_N;
  axis.effects = {{.id = "motor_presliding", .values = {over_m}, .lists = {}}};
  return axis;
}

/// Swings that slip some of the time: 22 N, which the positive direction holds, and 60 N.
double motor_N(int tick) {
  const double t_s = tick * tick_s;
  return (t_s < 0.5 ? 22.0 : 60.0) * std::sin(2.0 * test::pi * 9.0 * t_s);
}

/// M dv/dt = motor - B v - F, dF/dt = sigma v (1 - F / F_M) the way it moves; in steps of a microsecond.
struct Reference {
  double position_m = 0.0, velocity_m_per_s = 0.0, force_N = 0.0;

  void tick(double motor_N) {
    constexpr double h_s = 1e-6, stiffness_N_per_m = 0.5 * (coulomb_N.pos + coulomb_N.neg) / gone_m;
    constexpr double mass_kg = test::screw_mass_kg + test::table_mass_kg;
    constexpr double viscous_Ns_per_m = test::screw_viscous_Ns_per_m + test::guide_viscous_Ns_per_m;
    for (int i = 0; i < 1000; ++i) {
      velocity_m_per_s += h_s * (motor_N - viscous_Ns_per_m * velocity_m_per_s - force_N) / mass_kg;
      position_m += h_s * velocity_m_per_s;
      const double left = velocity_m_per_s > 0.0 ? 1.0 - force_N / coulomb_N.pos : 1.0 + force_N / coulomb_N.neg;
      force_N += h_s * stiffness_N_per_m * velocity_m_per_s * left;
    }
  }
};

TEST(MotorPresliding, MovesAsAnIndependentIntegrationSays) {
  FeedAxis axis(axis_over(gone_m), tenth_of_a_count), rigid(axis_over(0.0), tenth_of_a_count);
  Reference reference;
  double off_m = 0.0, rigid_off_m = 0.0;
  for (int tick = 0; tick < 1000; ++tick) {
    reference.tick(motor_N(tick));
    const AxisCommand command{motor_N(tick) / test::rad_per_m, 0.0};
    off_m = std::max(off_m, std::abs(axis.step(command, tick_s).position_m - reference.position_m));
    rigid_off_m = std::max(rigid_off_m, std::abs(rigid.step(command, tick_s).position_m - reference.position_m));
  }
  EXPECT_LT(off_m, 0.02 * rigid_off_m) << off_m << " of " << rigid_off_m;
  EXPECT_GT(rigid_off_m, 10.0 * gone_m);
}

TEST(MotorPresliding, IsCoulombFrictionOnceItSlides) {
  FeedAxis axis(axis_over(gone_m)), rigid(axis_over(0.0));
  for (auto* one : {&axis, &rigid})
    for (int tick = 0; tick < 3000; ++tick) one->step({50.0 / test::rad_per_m, 0.0}, tick_s);
  EXPECT_NEAR(axis.state().velocity_m_per_s, rigid.state().velocity_m_per_s, 1e-9);
  const AxisCommand command{50.0 / test::rad_per_m, 0.0};
  EXPECT_NEAR(axis.force_sensors(command).torque_sensor_Nm, rigid.force_sensors(command).torque_sensor_Nm, 1e-8);
  EXPECT_NEAR((50.0 / test::rad_per_m - axis.force_sensors(command).torque_sensor_Nm) * test::rad_per_m,
              coulomb_N.pos + 1e-4 * test::rad_per_m * test::rad_per_m * axis.state().velocity_m_per_s, 1e-3);
}

}  // namespace
}  // namespace feedtwin::plant

#include "plant/machine/spindle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace feedtwin::plant {
namespace {

constexpr double rpm = 2.0 * std::numbers::pi / 60.0;

TEST(Spindle, LossAtSpeedIsTheSumOfTable5sTerms) {
  for (const auto& p : {spindle_motor_A(), spindle_motor_B()}) {
    Spindle spindle(p);
    const double w = 3000 * rpm;
    for (int i = 0; i < 5000; ++i) spindle.step(w, 0.0, 1e-3);
    EXPECT_NEAR(spindle.speed_rad_per_s(), w, 1e-6 * w);
    const auto before = spindle.energy();
    for (int i = 0; i < 1000; ++i) spindle.step(w, 0.0, 1e-3);
    const auto after = spindle.energy();
    const double expected =
        p.ke0_W + p.ke1_Ws_per_rad * w + p.ke2_Ws2_per_rad2 * w * w + p.coulomb_Nm * w + p.viscous_Nms * w * w;
    const double input = after.electrical_J + after.shaft_work_J - before.electrical_J - before.shaft_work_J;
    EXPECT_NEAR(input / expected, 1.0, 1e-6);
  }
}

TEST(Spindle, EnergyBalancesThroughRunUpCutReversalAndStop) {
  Spindle spindle(spindle_motor_A());
  for (int i = 0; i < 12000; ++i) {
    const double command = i < 3000 ? 300 : i < 6000 ? -200 : i < 9000 ? 50 : 0;
    spindle.step(command, i > 1000 && i < 2000 ? 0.02 * (1 + std::sin(0.6 * i)) : 0.0, 1e-3);
  }
  const auto& e = spindle.energy();
  EXPECT_NEAR(e.shaft_work_J, e.friction_J + e.cutting_J + e.kinetic_J, 1e-9 * e.friction_J);
  EXPECT_GT(e.cutting_J, 1.0);
  EXPECT_EQ(spindle.speed_rad_per_s(), 0.0);
}

TEST(Spindle, AStandingSpindleSticksAndDrawsItsIdlePower) {
  Spindle spindle(spindle_motor_B());
  for (int i = 0; i < 1000; ++i) spindle.step(0.0, 0.0, 1e-3);
  EXPECT_EQ(spindle.speed_rad_per_s(), 0.0);
  EXPECT_NEAR(spindle.energy().electrical_J, spindle_motor_B().ke0_W, 1e-12);
}

TEST(Spindle, CuttingTorqueBeyondTheLimitStallsIt) {
  Spindle spindle(spindle_motor_A());
  for (int i = 0; i < 2000; ++i) spindle.step(300.0, 0.0, 1e-3);
  for (int i = 0; i < 2000; ++i) spindle.step(300.0, 0.5, 1e-3);
  EXPECT_EQ(spindle.speed_rad_per_s(), 0.0) << "it stops and does not run backwards";
}

}  // namespace
}  // namespace feedtwin::plant

#include "plant/machine/machine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "plant/parameter_table.h"

namespace feedtwin::plant {
namespace {

constexpr CuttingCoefficients plastic{160e6, 50e6, 20e6, 1.1e3, 1.0e3, 0.0};

MachineParameters source_like() {
  MachineParameters p;
  p.x = p.y = source_axis();
  p.spindle = spindle_motor_A();
  p.cutting = plastic;
  return p;
}

/// Commands that change every 20 ticks, most of them sensible, the same for the same seed.
class Driver {
 public:
  explicit Driver(unsigned seed) : random_(seed) {}
  const MachineCommand& next() {
    if (tick_++ % 20 == 0) draw();
    return command_;
  }
  double uniform(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }

 private:
  void draw() {
    command_.torque_x_Nm = uniform(-1.0, 1.0);
    command_.torque_y_Nm = uniform(-1.0, 1.0);
    command_.spindle_speed_rad_per_s = uniform(-500.0, 500.0);
    command_.pump = uniform(0.0, 1.0) < 0.5;
    command_.engagement = uniform(0.0, 1.0) < 0.6 ? slot(uniform(1e-5, 2e-3), uniform(-3.1, 3.1)) : Engagement{};
  }
  std::mt19937 random_;
  int tick_ = 0;
  MachineCommand command_;
};

TEST(Machine, EnergyBalancesForAnyMachineAndAnyCommands) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    Driver driver(seed);
    MachineParameters p = source_like();
    p.spindle = seed % 2 == 0 ? spindle_motor_A() : spindle_motor_B();
    p.auxiliary.pump_policy = static_cast<PumpPolicy>(seed % 3);
    p.tool = {.diameter_m = driver.uniform(2e-3, 2e-2),
              .teeth = 1 + static_cast<int>(seed % 5),
              .helix_rad = driver.uniform(0.0, 0.8),
              .runout_m = seed % 4 == 0 ? driver.uniform(0.0, 2e-5) : 0.0};
    p.regenerative = seed % 3 == 0;
    const double step_s = seed % 2 == 0 ? 1e-3 : 2.5e-4;
    Machine machine(p);
    double joules = 0.0, removed_m3 = 0.0;
    for (int tick = 0; tick < 3000; ++tick) {
      const auto& s = machine.step(driver.next(), step_s);
      joules += s.power_W * step_s;
      removed_m3 += s.cut.removal_rate_m3_per_s * step_s;
      ASSERT_TRUE(std::isfinite(s.power_W) && std::isfinite(s.cut.force_x_N) && std::isfinite(s.cut.torque_Nm)) << tick;
      ASSERT_GE(s.cut.removal_rate_m3_per_s, 0.0);
    }
    const auto e = machine.energy();
    EXPECT_LT(e.balance_error(), 1e-9);  // asked for: 1e-3
    EXPECT_NEAR(joules / e.total_J(), 1.0, 1e-9);
    EXPECT_NEAR(removed_m3, e.removed_m3, 1e-15);
    EXPECT_NEAR(e.time_s, 3000 * step_s, 1e-9);
    EXPECT_EQ(machine.clipped_inputs(), 0);
  }
}

TEST(Machine, WhatIsNotFiniteIsCountedAndDoesNoHarm) {
  Machine machine(source_like());
  const double bad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1e300};
  for (int tick = 0; tick < 300; ++tick) {
    MachineCommand command{
        .torque_x_Nm = 0.1, .torque_y_Nm = 0.1, .spindle_speed_rad_per_s = 100.0, .engagement = slot(1e-4)};
    if (tick >= 200) {
      (tick % 3 == 0   ? command.torque_x_Nm
       : tick % 3 == 1 ? command.torque_y_Nm
                       : command.spindle_speed_rad_per_s) = bad[tick % 2];
    }
    const auto& s = machine.step(command, 1e-3);
    ASSERT_TRUE(std::isfinite(s.x.position_m + s.y.position_m + s.spindle_speed_rad_per_s + s.power_W)) << tick;
  }
  EXPECT_EQ(machine.clipped_inputs(), 100);
}

TEST(Machine, ThePumpFollowsItsPolicy) {
  for (const auto policy : {PumpPolicy::commanded, PumpPolicy::always, PumpPolicy::cutting}) {
    MachineParameters p = source_like();
    p.auxiliary.pump_policy = policy;
    Machine machine(p);
    for (const bool commanded : {false, true}) {
      for (const bool cutting : {false, true}) {
        MachineCommand command{.spindle_speed_rad_per_s = 300.0, .pump = commanded};
        if (cutting) command.engagement = slot(1e-4);
        const bool on = policy == PumpPolicy::always || (commanded && (policy == PumpPolicy::commanded || cutting));
        EXPECT_EQ(machine.step(command, 1e-3).pump_on, on) << static_cast<int>(policy) << commanded << cutting;
      }
    }
    const int ticks_on = policy == PumpPolicy::always ? 4 : policy == PumpPolicy::commanded ? 2 : 1;
    EXPECT_NEAR(machine.energy().pump_J, ticks_on * 1e-3 * p.auxiliary.pump_W, 1e-12);
  }
}

TEST(Machine, AToolThatStandsIsNotPushedThroughMaterialSilently) {
  Machine machine(source_like());
  for (int tick = 0; tick < 200; ++tick) machine.step({.torque_x_Nm = 0.5, .engagement = slot(1e-3)}, 1e-3);
  EXPECT_GT(machine.stalled_ticks(), 150);
  EXPECT_EQ(machine.energy().removed_m3, 0.0);
}

TEST(Machine, TheCutTakesAsMuchFromSpindleAndAxesAsTheEdgesGive) {
  Machine machine(source_like());
  for (int tick = 0; tick < 4000; ++tick) {
    machine.step({.torque_x_Nm = 0.4, .torque_y_Nm = 0.0, .spindle_speed_rad_per_s = 314.0, .engagement = slot(5e-4)}, 1e-3);
    if (std::abs(machine.signals().x.position_m) > 0.06) break;
  }
  const auto e = machine.energy();
  EXPECT_GT(e.tip_J, 0.1);
  EXPECT_NEAR((e.x.cutting_J + e.y.cutting_J + e.spindle.cutting_J) / e.tip_J, 1.0, 1e-9);
}

TEST(Machine, TheSameCommandsTwiceAreTheSameToTheLastBit) {
  Machine first(source_like()), second(source_like());
  Driver a(9), b(9);
  for (int tick = 0; tick < 2000; ++tick) {
    first.step(a.next(), 1e-3);
    second.step(b.next(), 1e-3);
  }
  EXPECT_EQ(first.energy().total_J(), second.energy().total_J());
  EXPECT_EQ(first.x().state().position_m, second.x().state().position_m);
}

}  // namespace
}  // namespace feedtwin::plant

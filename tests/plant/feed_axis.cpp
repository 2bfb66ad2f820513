#include "plant/feed_axis.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "plant/parameter_table.h"
#include "tests/support/random_axis.h"
#include "tests/support/tick.h"

namespace feedtwin::plant {
namespace {

using test::tick_s;

/// What may come from outside: within limits, beyond them, and what is no number.
class Inputs {
 public:
  explicit Inputs(std::uint64_t seed) : random_(seed) {}
  double next(double limit) {
    constexpr double inf = std::numeric_limits<double>::infinity();
    constexpr std::array odd = {0.0,    -0.0,    inf, -inf, std::numeric_limits<double>::quiet_NaN(), 1e300, -1e300,
                                5e-324, -2e-310, 1e6, -1e6};
    const double kind = uniform(0.0, 1.0);
    if (kind < 0.15) return odd[std::uniform_int_distribution<std::size_t>(0, odd.size() - 1)(random_)];
    if (kind < 0.3) return kind < 0.22 ? limit : -limit;
    if (kind < 0.5) return held_;
    return held_ = uniform(-limit, limit) * (kind < 0.7 ? 0.1 : 1.0);
  }
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

 private:
  std::mt19937_64 random_;
  double held_ = 0.0;
};

double bristle_limit_m(const LugreParameters& p) {
  return std::max(p.static_N.pos, p.static_N.neg) / p.stiffness_N_per_m;
}

std::string numbers_of(AxisParameters p) {
  std::string text;
  for (const auto& entry : parameter_table())
    text += std::string(entry.key) + " = " + testing::PrintToString(entry.in(p)) + "\n";
  return text;
}

/// A million ticks over a thousand axes: whatever the input, the state stays finite, bristles within F_S / sigma0, energy
/// balances.
void expect_sound(const AxisParameters& parameters, Inputs& inputs, int ticks, double largest_balance_error) {
  FeedAxis axis(parameters);
  for (int i = 0; i < ticks; ++i) {
    const AxisCommand command{.torque_Nm = inputs.next(parameters.axis.torque_limit_Nm),
                              .cutting_force_N = inputs.uniform(0, 1) < 0.5 ? 0.0 : inputs.next(500.0)};
    const AxisSignals& s = axis.step(command, tick_s);
    const AxisState<double>& y = axis.state();
    ASSERT_TRUE(std::isfinite(y.position_m) && std::isfinite(y.velocity_m_per_s) && std::isfinite(y.acceleration_m_per_s2) &&
                std::isfinite(s.power_W) && std::isfinite(axis.energy().lost_J))
        << "tick " << i << " torque " << command.torque_Nm << " cutting " << command.cutting_force_N << "\n"
        << numbers_of(parameters);
    ASSERT_LE(std::abs(y.screw_bristle_m), bristle_limit_m(parameters.ball_screw) * (1.0 + 1e-9)) << "tick " << i << "\n"
                                                                                                  << numbers_of(parameters);
    ASSERT_LE(std::abs(y.guide_bristle_m), bristle_limit_m(parameters.guide) * (1.0 + 1e-9)) << "tick " << i << "\n"
                                                                                             << numbers_of(parameters);
    ASSERT_LE(std::abs(s.torque_Nm), parameters.axis.torque_limit_Nm);
  }
  const AxisEnergy e = axis.energy();
  ASSERT_LE(e.balance_error(), largest_balance_error)
      << "work in " << e.input_work_J << " motor " << e.motor_mechanical_J << " screw " << e.ball_screw_J << " guide "
      << e.guide_J << " cutting " << e.cutting_J << " stop " << e.end_stop_J << " throughput " << e.throughput_J << "\n"
      << numbers_of(parameters);
}

TEST(FeedAxis, AnyInputOnAxesLikeTheSource) {
  std::mt19937_64 random(31);
  Inputs inputs(32);
  for (int i = 0; i < 1000; ++i) {
    expect_sound(tests::axis_near_source(random, 4.0), inputs, 700, 1e-9);
    if (HasFatalFailure()) FAIL() << "axis " << i;
  }
}

TEST(FeedAxis, AnyInputOnAnyAxisThatAFileMayDescribe) {
  std::mt19937_64 random(33);
  Inputs inputs(34);
  for (int i = 0; i < 1000; ++i) {
    expect_sound(tests::any_axis(random), inputs, 300, 1e-6);
    if (HasFatalFailure()) FAIL() << "axis " << i;
  }
}

TEST(FeedAxis, NeverMakesEnergy) {
  std::mt19937_64 random(35);
  Inputs inputs(36);
  for (int round = 0; round < 300; ++round) {
    AxisParameters p = tests::axis_near_source(random, 3.0);
    // where LuGre itself is passive; see tests/plant/lugre.cpp
    for (auto* f : {&p.ball_screw, &p.guide}) {
      f->viscous_Ns_per_m.pos =
          std::max(f->viscous_Ns_per_m.pos, f->damping_Ns_per_m * (f->static_N.pos / f->coulomb_N.pos - 1.0));
      f->viscous_Ns_per_m.neg =
          std::max(f->viscous_Ns_per_m.neg, f->damping_Ns_per_m * (f->static_N.neg / f->coulomb_N.neg - 1.0));
    }
    FeedAxis axis(p);
    double lost_J = 0.0;
    for (int i = 0; i < 1000; ++i) {
      axis.step({.torque_Nm = inputs.next(1.0)}, tick_s);
      const AxisEnergy e = axis.energy();
      ASSERT_GE(e.lost_J, lost_J - 1e-9 * (1.0 + e.throughput_J)) << "tick " << i << "\n" << numbers_of(p);
      lost_J = e.lost_J;
    }
  }
}

// On Table 2 itself, whose guide (F_S / F_C = 2) is not passive for a few micrometres after a hard breakaway.
TEST(FeedAxis, NeverHoldsMoreEnergyThanItWasGiven) {
  Inputs inputs(37);
  double most_given_back_J = 0.0;
  for (int round = 0; round < 200; ++round) {
    FeedAxis axis(source_axis());
    double lost_J = 0.0;
    for (int i = 0; i < 1000; ++i) {
      axis.step({.torque_Nm = inputs.next(1.9)}, tick_s);
      const double now_J = axis.energy().lost_J;
      ASSERT_GE(now_J, 0.0) << "round " << round << " tick " << i;
      most_given_back_J = std::max(most_given_back_J, lost_J - now_J);
      lost_J = now_J;
    }
  }
  EXPECT_LT(most_given_back_J, 1e-4);
  printf("  largest energy given back within a tick: %.2e J\n", most_given_back_J);
}

TEST(FeedAxis, MotorFrictionSticksAndDoesNotChatter) {
  std::mt19937_64 random(41);
  std::uniform_real_distribution<double> share(-0.999, 0.999);
  for (int round = 0; round < 500; ++round) {
    const AxisParameters p = tests::axis_near_source(random, 2.0);
    FeedAxis axis(p);
    const double k = axis.model().transmission_rad_per_m;
    axis.place(0.0, 0.02 * share(random));
    // less than the motor's own friction: it must come to rest once, and stay exactly there
    const double force_N = share(random) * std::min(p.motor.coulomb_N.pos, p.motor.coulomb_N.neg) * 0.5;
    int since_rest = 0;
    double rest_m = 0.0;
    for (int i = 0; i < 3000; ++i) {
      axis.step({.torque_Nm = force_N / k}, tick_s);
      // bristles may push it out of its first rests; then it is held for good
      if (axis.state().velocity_m_per_s == 0.0 && since_rest++ == 0) rest_m = axis.state().position_m;
      if (axis.state().velocity_m_per_s != 0.0) since_rest = 0;
    }
    ASSERT_GT(since_rest, 2000) << "round " << round << " force " << force_N << "\n" << numbers_of(p);
    ASSERT_EQ(axis.state().position_m, rest_m);
  }
}

TEST(FeedAxis, LeavesRestOnlyBeyondTheMotorsFriction) {
  std::mt19937_64 random(42);
  for (int round = 0; round < 500; ++round) {
    const AxisParameters p = tests::axis_near_source(random, 2.0);
    const double k = 2.0 * std::numbers::pi / p.axis.lead_m;
    for (const double sign : {1.0, -1.0}) {
      const double holds_N = sign > 0.0 ? p.motor.coulomb_N.pos : p.motor.coulomb_N.neg;
      FeedAxis held(p), moved(p);
      for (int i = 0; i < 50; ++i) {
        held.step({.torque_Nm = sign * holds_N * (1.0 - 1e-9) / k}, tick_s);
        moved.step({.torque_Nm = sign * holds_N * (1.0 + 1e-6) / k}, tick_s);
        ASSERT_EQ(held.state().velocity_m_per_s, 0.0);
        ASSERT_EQ(held.state().position_m, 0.0);
      }
      ASSERT_GT(sign * moved.state().position_m, 0.0) << "round " << round << "\n" << numbers_of(p);
    }
  }
}

TEST(FeedAxis, SameInputSameBits) {
  Inputs inputs(43);
  FeedAxis one(source_axis()), other(source_axis());
  for (int i = 0; i < 100000; ++i) {
    const AxisCommand command{.torque_Nm = inputs.next(1.9), .cutting_force_N = inputs.next(100.0)};
    const AxisSignals a = one.step(command, tick_s);
    const AxisSignals b = other.step(command, tick_s);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(a.position_m), std::bit_cast<std::uint64_t>(b.position_m));
    ASSERT_EQ(std::bit_cast<std::uint64_t>(a.power_W), std::bit_cast<std::uint64_t>(b.power_W));
    ASSERT_EQ(std::bit_cast<std::uint64_t>(one.state().screw_bristle_m),
              std::bit_cast<std::uint64_t>(other.state().screw_bristle_m));
  }
}

TEST(FeedAxis, ToTenMetresASecondAndBack) {
  for (const double sign : {1.0, -1.0}) {
    AxisParameters p = source_axis();
    p.axis.stroke_m = 100.0;
    p.axis.torque_limit_Nm = 100.0;
    FeedAxis axis(p);
    double fastest = 0.0;
    for (int i = 0; i < 1500; ++i) {
      axis.step({.torque_Nm = sign * (i < 700 ? 60.0 : i < 900 ? 30.0 : -60.0)}, tick_s);
      fastest = std::max(fastest, std::abs(axis.state().velocity_m_per_s));
    }
    EXPECT_GT(fastest, 10.0);
    EXPECT_LT(sign * axis.state().velocity_m_per_s, 0.0);
    EXPECT_LT(axis.energy().balance_error(), 1e-9);
    for (int i = 0; i < 5000; ++i) axis.step({}, tick_s);
    EXPECT_EQ(axis.state().velocity_m_per_s, 0.0);
  }
}

TEST(FeedAxis, EndStopsHold) {
  for (const double sign : {1.0, -1.0}) {
    FeedAxis axis(source_axis());
    for (int i = 0; i < 3000; ++i) {
      axis.step({.torque_Nm = sign * 1.9}, tick_s);
      ASSERT_LT(sign * axis.state().position_m, 0.075 + 2.5e-3) << "hit at full speed";
    }
    const double pushed_N = 1.9 * axis.model().transmission_rad_per_m;
    EXPECT_NEAR(sign * axis.state().position_m, 0.075, 1.1 * pushed_N / 2e7);
    EXPECT_GT(sign * axis.state().position_m, 0.075);
    EXPECT_EQ(axis.state().velocity_m_per_s, 0.0);
    EXPECT_LT(axis.energy().balance_error(), 1e-6);
  }
}

TEST(FeedAxis, IndexOnceARevolution) {
  FeedAxis axis(source_axis());
  int passes = 0;
  std::int64_t last = axis.encoder().counts_per_rev();
  last = 0;
  for (int i = 0; i < 2000 && axis.state().position_m < 0.05; ++i) {
    axis.step({.torque_Nm = 0.5}, tick_s);
    passes += axis.signals().index_passed;
  }
  last = axis.signals().encoder_counts / axis.encoder().counts_per_rev();
  EXPECT_EQ(passes, last) << "the count at the start lies on an index and does not count";
  EXPECT_GE(passes, 9);
}

TEST(FeedAxis, ClippedInputsAreCounted) {
  FeedAxis axis(source_axis());
  axis.step({.torque_Nm = 1.0}, tick_s);
  EXPECT_EQ(axis.clipped_inputs(), 0);
  axis.step({.torque_Nm = 2.0}, tick_s);
  EXPECT_EQ(axis.clipped_inputs(), 1);
  EXPECT_EQ(axis.signals().torque_Nm, 1.9);
  axis.step({.torque_Nm = std::nan(""), .cutting_force_N = std::numeric_limits<double>::infinity()}, tick_s);
  EXPECT_GE(axis.clipped_inputs(), 2);
  EXPECT_EQ(axis.signals().torque_Nm, 0.0);
}

// The paper's testbed computes losses from sensors (Eqs. 11-14); the same from the plant's own sensors must give what the
// model's terms give (Eqs. 7-10). The mean of a tick's two ends stands for the tick.
TEST(FeedAxis, SensorEquationsGiveTheModelsEnergy) {
  AxisParameters p = source_axis();
  p.axis.stroke_m = 10.0;
  FeedAxis axis(p);
  const double k = axis.model().transmission_rad_per_m;
  double electrical_J = 0.0, motor_J = 0.0, screw_J = 0.0, guide_J = 0.0;
  const auto command_at = [](int i) {
    return AxisCommand{.torque_Nm = 0.45 * std::sin(2.0 * std::numbers::pi * 1.0 * i * tick_s)};
  };
  for (int i = 0; i < 10000; ++i) {
    const AxisCommand command = command_at(i);
    const ForceSignals start = axis.force_sensors(command);
    const double from_m = axis.state().position_m;
    axis.step(command, tick_s);
    const ForceSignals end = axis.force_sensors(command);
    const double path_m = axis.state().position_m - from_m;  // x' dt
    const double torque_Nm = 0.5 * (start.torque_sensor_Nm + end.torque_sensor_Nm);
    const double force_N = 0.5 * (start.force_sensor_N + end.force_sensor_N);
    electrical_J += axis.signals().power_W * tick_s - k * path_m * axis.signals().torque_Nm;  // Eq. 11
    motor_J += k * path_m * (axis.signals().torque_Nm - torque_Nm);                           // Eq. 12
    screw_J += path_m * (k * torque_Nm - force_N);                                            // Eq. 13
    guide_J += path_m * force_N;                                                              // Eq. 14
  }
  const AxisEnergy e = axis.energy();
  EXPECT_GT(e.ball_screw_J, 20.0);
  EXPECT_NEAR(electrical_J, e.motor_electrical_J, 1e-6 * e.motor_electrical_J);
  EXPECT_NEAR(motor_J, e.motor_mechanical_J, 1e-4 * e.motor_mechanical_J);
  EXPECT_NEAR(screw_J, e.ball_screw_J, 1e-4 * e.ball_screw_J);
  EXPECT_NEAR(guide_J, e.guide_J, 1e-4 * e.guide_J);
  printf("  Eqs. 12-14 differ by %.2e %.2e %.2e\n", motor_J / e.motor_mechanical_J - 1, screw_J / e.ball_screw_J - 1,
         guide_J / e.guide_J - 1);
}

TEST(FeedAxis, CuttingForceDoesItsWork) {
  FeedAxis axis(source_axis());
  for (int i = 0; i < 1000; ++i) axis.step({.torque_Nm = 0.5, .cutting_force_N = 100.0}, tick_s);
  EXPECT_NEAR(axis.energy().cutting_J, 100.0 * axis.state().position_m, 1e-9);
  EXPECT_GT(axis.state().position_m, 0.0);
  EXPECT_LT(axis.energy().balance_error(), 1e-9);
}

}  // namespace
}  // namespace feedtwin::plant

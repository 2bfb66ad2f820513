// Effects with a state of their own against an independent integration in steps of a microsecond.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "plant/effects/coupling.h"
#include "plant/effects/presliding_memory.h"
#include "plant/feed_axis.h"
#include "tests/support/smooth_axis.h"
#include "tests/support/tick.h"

namespace feedtwin::plant {
namespace {

using test::count_m;
using test::rad_per_m;
using test::ReferenceBody;
using test::tick_s;

FeedAxis axis_with(std::vector<EffectSetting> effects, Resolution resolution = one_count) {
  AxisParameters p = test::smooth_axis();
  p.effects = std::move(effects);
  return FeedAxis(p, resolution);
}

Resolution substeps(int count) {
  return {.sliding = count, .settling = count, .reversing = count};
}

/// A command that changes with every tick and reverses the motion many times.
double command_Nm(int tick) {
  return 0.12 * std::sin(0.031 * tick) + 0.05 * std::sin(0.4 * tick + 1.0) + (tick % 97 < 10 ? 0.08 : 0.0);
}

/// Largest distance between plant and reference over a run, m.
double distance_m(FeedAxis& axis, int ticks, const std::function<double(double)>& motor_Nm,
                  const std::function<double(double, double, double)>& load_N) {
  ReferenceBody body;
  double worst = 0.0;
  for (int i = 0; i < ticks; ++i) {
    axis.step({command_Nm(i)}, tick_s);
    body.run(tick_s, [&](double t) { return rad_per_m * motor_Nm(t); }, load_N);
    worst = std::max(worst, std::abs(axis.state().position_m - body.x));
  }
  return worst;
}

double held_Nm(double t) {
  return command_Nm(static_cast<int>(std::floor(t / tick_s + 1e-7)));
}

double no_load(double, double, double) {
  return 0.0;
}

TEST(Dynamics, ReferenceAndPlantAgreeWithoutEffects) {
  FeedAxis axis = axis_with({});
  EXPECT_LT(distance_m(axis, 400, held_Nm, no_load), count_m);
}

TEST(Dynamics, CurrentLoopLag) {
  for (const double lag_s : {2e-4, 1e-3, 3.6e-3, 2e-2}) {
    FeedAxis axis = axis_with({{"current_loop_lag", {lag_s}, {}}});
    std::vector<double> at_start{0.0};  // the lag's exact answer to a held command
    for (int i = 0; i < 400; ++i) {
      at_start.push_back(command_Nm(i) + (at_start.back() - command_Nm(i)) * std::exp(-tick_s / lag_s));
    }
    const auto lagging = [&](double t) {
      const auto i = static_cast<std::size_t>(t / tick_s + 1e-7);
      const double command = command_Nm(static_cast<int>(i));
      return command + (at_start[i] - command) * std::exp(-(t - static_cast<double>(i) * tick_s) / lag_s);
    };
    EXPECT_LT(distance_m(axis, 399, lagging, no_load), 3.0 * count_m) << lag_s;
  }
}

TEST(Dynamics, InputDelayOfBrokenTicks) {
  for (const double delay_s : {3e-4, 1e-3, 2.6e-3, 1.25e-2}) {
    FeedAxis axis = axis_with({{"input_delay", {delay_s}, {}}});
    const auto late = [&](double t) { return t < delay_s - 1e-9 ? 0.0 : held_Nm(t - delay_s + 1e-9); };
    EXPECT_LT(distance_m(axis, 300, late, no_load), 3.0 * count_m) << delay_s;
  }
}

TEST(Dynamics, CoggingAndCableSpring) {
  FeedAxis axis = axis_with({{"cogging", {0.025, 12.0, 0.7}, {}}, {"cable_spring", {900.0, -0.01}, {}}}, substeps(12));
  const auto load = [](double, double x, double) {
    return 0.025 * rad_per_m * std::sin(12.0 * rad_per_m * x + 0.7) + 900.0 * (x + 0.01);
  };
  EXPECT_LT(distance_m(axis, 300, held_Nm, load), 10.0 * count_m);
}

TEST(Dynamics, QuadraticDragAndProcessForce) {
  for (const double ramp_s : {0.0, 0.04}) {
    FeedAxis axis = axis_with(
        {{"quadratic_drag", {3000.0}, {}}, {"process_force", {20.0, 30.0, 70.0, 0.3, 0.05, 0.32, 12.0, ramp_s}, {}}});
    const auto load = [&](double t, double, double v) {
      const double in_cut = std::clamp(std::min(t - 0.05, 0.32 - t) / std::max(ramp_s, 1e-9) + 0.5, 0.0, 1.0);
      return 3000.0 * v * std::abs(v) +
             in_cut * (20.0 + 12.0 * std::tanh(v / 5e-4) + 30.0 * std::sin(2.0 * test::pi * 70.0 * t + 0.3));
    };
    EXPECT_LT(distance_m(axis, 400, held_Nm, load), 2.0 * count_m) << ramp_s;
  }
}

TEST(Dynamics, DragWeightAndCableSpring) {
  FeedAxis axis =
      axis_with({{"quadratic_drag", {3000.0}, {}}, {"gravity", {25.0}, {}}, {"cable_spring", {900.0, -0.01}, {}}});
  const auto load = [](double, double x, double v) { return 3000.0 * v * std::abs(v) + 25.0 + 900.0 * (x + 0.01); };
  EXPECT_LT(distance_m(axis, 400, held_Nm, load), 2.0 * count_m);
}

/// Maxwell-slip elements walked along a path, each clipped: the virgin curve and every loop follow.
TEST(Dynamics, PreslidingMemoryFollowsItsElements) {
  constexpr double force_N = 60.0;
  constexpr double distance = 2e-5;
  constexpr int elements = 8;
  FeedAxis axis = axis_with({{"presliding_memory", {force_N, distance}, {}}}, substeps(20));
  std::array<double, elements> e{};
  double last_x = 0.0;
  const auto load = [&](double, double x, double) {  // called in order of time but for half steps of 1 us: 1e-9 m
    double sum = 0.0;
    for (int i = 0; i < elements; ++i) {
      const double most = distance * (i + 0.5) / elements;
      e[static_cast<std::size_t>(i)] = std::clamp(e[static_cast<std::size_t>(i)] + x - last_x, -most, most);
      sum += e[static_cast<std::size_t>(i)];
    }
    last_x = x;
    return 2.0 * force_N / (elements * distance) * sum;
  };
  EXPECT_LT(distance_m(axis, 300, held_Nm, load), 20.0 * count_m);
  // at rest after a long way it holds no more than its force, and its virgin curve is a parabola
  effects::PreslidingMemory law({test::smooth_axis(), make_axis_model(test::smooth_axis())},
                                {"presliding_memory", {force_N, distance}, {}});
  double x = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const EffectMotion m{.position_m = x,
                         .velocity_m_per_s = 3e-5,
                         .sign = 1.0,
                         .acceleration_m_per_s2 = 0.0,
                         .torque_Nm = 0.0,
                         .table_load_N = 0.0,
                         .h_s = 1e-3,
                         .time_s = 0.0,
                         .tick_phase_s = 0.0};
    law.advance(m);
    x += 3e-8;
    const double share = std::min(1.0, x / distance);
    EXPECT_NEAR(law.load({.position_m = x,
                          .velocity_m_per_s = 0.0,
                          .sign = 1.0,
                          .acceleration_m_per_s2 = 0.0,
                          .torque_Nm = 0.0,
                          .table_load_N = 0.0,
                          .h_s = 1e-9,
                          .time_s = 0.0,
                          .tick_phase_s = 0.0})
                    .force_N,
                force_N * share * (2.0 - share), 0.005 * force_N);
  }
}

/// A part that the table drags along by a spring and a damper, walked in half steps of a microsecond.
TEST(Dynamics, LearnedModeSwingsAsAPartOnASpring) {
  constexpr double mass_kg = 20.0, frequency_Hz = 12.0, damping_ratio = 0.05, w = 2.0 * test::pi * frequency_Hz;
  FeedAxis axis = axis_with({{"learned_mode", {mass_kg, frequency_Hz, damping_ratio}, {}}}, substeps(20));
  double last_s = 0.0, ahead_m = 0.0, speed = 0.0, most_N = 0.0;
  const auto load = [&](double t, double, double v) {
    const double acceleration = w * (w * ahead_m + 2.0 * damping_ratio * (v - speed));
    ahead_m += (t - last_s) * (v - speed);
    speed += (t - last_s) * acceleration;
    last_s = t;
    most_N = std::max(most_N, std::abs(mass_kg * acceleration));
    return mass_kg * acceleration;
  };
  EXPECT_LT(distance_m(axis, 400, held_Nm, load), 2.0 * count_m);
  EXPECT_GT(most_N, 10.0);
}

/// Two bodies and a spring with play, by Runge and Kutta in steps of 0.5 us.
struct ReferencePair {
  double gap_m, stiffness, damping;
  std::array<double, 4> y{};  ///< screw x, v; table x, v

  [[nodiscard]] std::array<double, 4> rate(const std::array<double, 4>& s, double motor_N) const {
    const double d = s[0] - s[2];
    const double beyond = std::max(d - 0.5 * gap_m, 0.0) + std::min(d + 0.5 * gap_m, 0.0);
    double force = beyond == 0.0 ? 0.0 : stiffness * beyond + damping * (s[1] - s[3]);
    if (force * beyond < 0.0) force = 0.0;
    return {s[1], (motor_N - test::screw_viscous_Ns_per_m * s[1] - force) / test::screw_mass_kg, s[3],
            (force - test::guide_viscous_Ns_per_m * s[3]) / test::table_mass_kg};
  }
  void run(double duration_s, double motor_N) {
    constexpr double h = 5e-7;
    const auto along = [](std::array<double, 4> s, const std::array<double, 4>& r, double by) {
      for (std::size_t i = 0; i < 4; ++i) s[i] += by * r[i];
      return s;
    };
    for (long i = 0; i < static_cast<long>(duration_s / h + 0.5); ++i) {
      const auto k1 = rate(y, motor_N);
      const auto k2 = rate(along(y, k1, 0.5 * h), motor_N);
      const auto k3 = rate(along(y, k2, 0.5 * h), motor_N);
      const auto k4 = rate(along(y, k3, h), motor_N);
      for (std::size_t j = 0; j < 4; ++j) y[j] += h * (k1[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j]) / 6.0;
    }
  }
};

/// Largest error of table and screw, and the largest stretch between them in the reference.
struct PairError {
  double table_m = 0.0, screw_m = 0.0, stretch_m = 0.0, rms_m = 0.0;
};
PairError pair_error(const EffectSetting& effect, ReferencePair reference, Resolution resolution, int ticks) {
  FeedAxis axis = axis_with({effect}, resolution);
  PairError error;
  for (int i = 0; i < ticks; ++i) {
    axis.step({command_Nm(i)}, tick_s);
    reference.run(tick_s, rad_per_m * command_Nm(i));
    const double stretch = reference.y[0] - reference.y[2];
    const double stretch_error = axis.state().position_m - axis.table_position_m() - stretch;
    error.table_m = std::max(error.table_m, std::abs(axis.table_position_m() - reference.y[2]));
    error.screw_m = std::max(error.screw_m, std::abs(axis.state().position_m - reference.y[0]));
    error.stretch_m = std::max(error.stretch_m, std::abs(stretch));
    error.rms_m += stretch_error * stretch_error / ticks;
  }
  error.rms_m = std::sqrt(error.rms_m);
  return error;
}

TEST(Dynamics, ScrewCompliance) {
  const EffectSetting effect{"screw_compliance", {3e7, 2e3}, {}};
  const ReferencePair reference{0.0, 3e7, 2e3, {}};
  const auto coarse = pair_error(effect, reference, one_count, 300);
  EXPECT_LT(coarse.screw_m, 2.0 * count_m);
  EXPECT_LT(coarse.rms_m, 0.1 * coarse.stretch_m) << "stretch " << coarse.stretch_m;
  const auto fine = pair_error(effect, reference, substeps(48), 300);
  EXPECT_LT(fine.rms_m, 0.1 * coarse.rms_m) << "second order: eight times the sub-steps, a sixty-fourth of the error";
}

TEST(Dynamics, AStiffScrewSwingsAtItsOwnFrequency) {
  for (const double stiffness : {3e7, 6e7, 1.2e8, 2.4e8}) {  // 450 to 1270 Hz, with three or four sub-steps a tick
    const auto error = pair_error({"screw_compliance", {stiffness, 1e3}, {}}, {0.0, stiffness, 1e3, {}}, one_count, 300);
    EXPECT_LT(error.rms_m, 0.01 * error.stretch_m) << stiffness;
  }
}

TEST(Dynamics, Backlash) {
  for (const double gap_m : {2e-6, 1e-5, 5e-5}) {
    const EffectSetting effect{"backlash", {gap_m, 6e7, 2e3}, {}};
    const ReferencePair reference{gap_m, 6e7, 2e3, {}};
    const auto coarse = pair_error(effect, reference, one_count, 300);
    EXPECT_LT(coarse.screw_m, 6.0 * count_m) << gap_m;
    EXPECT_LT(coarse.rms_m, 0.15 * coarse.stretch_m) << gap_m;
    const auto fine = pair_error(effect, reference, substeps(96), 300);
    EXPECT_LT(fine.rms_m, 0.03 * coarse.stretch_m) << gap_m;
  }
}

TEST(Dynamics, AFlankThatIsPressedInSteadilyNeedsFewerSubSteps) {
  Coupling coupling({.gap_m = 1e-5, .stiffness_N_per_m = 6e7, .damping_Ns_per_m = 2e3},
                    make_axis_model(test::smooth_axis()));
  coupling.place(0.0, 0.0);
  EXPECT_FALSE(coupling.flank_bears(0.0)) << "in the gap";
  EXPECT_FALSE(coupling.flank_bears(5.4e-6)) << "just hit";
  EXPECT_TRUE(coupling.flank_bears(5.45e-6)) << "0.45 um deep, by 0.05 um more than a tick ago";
  EXPECT_FALSE(coupling.flank_bears(5.2e-6)) << "it is being left";
  EXPECT_EQ(coupling.substeps(6, true), 2);
  EXPECT_EQ(coupling.substeps(6, false), 6);
}

TEST(Dynamics, AStiffCouplingIsStableAtThreeSubSteps) {
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    const double stiffness = std::pow(10.0, std::uniform_real_distribution<double>(5.0, 9.99)(random));
    const double gap_m = i % 2 == 0 ? 0.0 : std::pow(10.0, std::uniform_real_distribution<double>(-7.0, -4.0)(random));
    AxisParameters p = test::smooth_axis();
    if (gap_m > 0.0) p.effects = {{"backlash", {gap_m, stiffness, 0.0}, {}}};
    if (gap_m == 0.0) p.effects = {{"screw_compliance", {stiffness, 0.0}, {}}};
    FeedAxis axis(p, substeps(3));
    double highest_J = 0.0;
    for (int tick = 0; tick < 300; ++tick) axis.step({command_Nm(tick)}, 2e-3);
    for (int tick = 0; tick < 300; ++tick) {  // left alone, energy only falls
      axis.step({}, 2e-3);
      const auto e = axis.energy();
      if (tick == 0) highest_J = e.kinetic_J + e.stored_J;
      ASSERT_LE(e.kinetic_J + e.stored_J, 1.001 * highest_J + 1e-12) << stiffness << " N/m, gap " << gap_m;
      highest_J = e.kinetic_J + e.stored_J;
    }
  }
}

}  // namespace
}  // namespace feedtwin::plant

// Laws of effects as an axis shows them from outside: force at steady speed, breakaway, what sensors and meter show.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "plant/feed_axis.h"
#include "plant/parameter_table.h"
#include "tests/support/smooth_axis.h"
#include "tests/support/tick.h"

namespace feedtwin::plant {
namespace {

using test::rad_per_m;
using test::tick_s;

AxisParameters long_axis(std::vector<EffectSetting> effects) {
  AxisParameters p = source_axis();
  p.axis.stroke_m = 20.0;
  p.axis.torque_limit_Nm = 20.0;
  p.effects = std::move(effects);
  return p;
}

/// The torque, as a force, that holds a speed after some time; a PI velocity loop finds it.
struct Steady {
  double force_N, position_m, screw_work_J, time_s;
};
Steady steady(FeedAxis& axis, double speed_m_per_s, double duration_s, double cutting_N = 0.0) {
  double integral_N = 0.0, mean_N = 0.0;
  const int ticks = static_cast<int>(duration_s / tick_s);
  for (int i = 0; i < ticks; ++i) {
    const double error = speed_m_per_s - axis.state().velocity_m_per_s;
    integral_N += 400.0 * error;
    const double force_N = 2e4 * error + integral_N;
    axis.step({force_N / rad_per_m, cutting_N}, tick_s);
    if (i >= ticks - 20) mean_N += force_N / 20.0;
  }
  return {mean_N, axis.state().position_m, axis.energy().ball_screw_J, duration_s};
}

/// Nominal friction at a steady speed, by the source's Eqs. 1-3.
struct Nominal {
  double screw_sliding_N, screw_viscous_N, others_N, guide_N;  ///< the guide's is one of the others
  [[nodiscard]] double all_N() const { return screw_sliding_N + screw_viscous_N + others_N; }
};
Nominal nominal(double v) {
  const auto p = source_axis();
  const auto side = v > 0.0 ? &Directional::pos : &Directional::neg;
  const auto sliding = [&](const LugreParameters& f) {
    return f.coulomb_N.*side + (f.static_N.*side - f.coulomb_N.*side) * std::exp(-std::abs(v) / f.stribeck_m_per_s.*side);
  };
  const double sign = v > 0.0 ? 1.0 : -1.0;
  return {sign * sliding(p.ball_screw), p.ball_screw.viscous_Ns_per_m.*side * v,
          sign * (sliding(p.guide) + p.motor.coulomb_N.*side) +
              (p.guide.viscous_Ns_per_m.*side + p.motor.damping_Nms.*side * rad_per_m * rad_per_m) * v,
          sign * sliding(p.guide) + p.guide.viscous_Ns_per_m.*side * v};
}

TEST(Laws, ForceAtSteadySpeed) {
  struct Row {
    EffectSetting effect;
    std::function<double(const Nominal&, double v, const Steady&)> expected_N;
    double cutting_N = 0.0;
  };
  const auto loaded_by = [](double guide_share) {
    return [=](const Nominal& n, double v, const Steady&) {
      const auto p = source_axis();
      const double coulomb = v > 0.0 ? p.ball_screw.coulomb_N.pos : p.ball_screw.coulomb_N.neg;
      return n.all_N() + 400.0 + 0.15 * std::abs(400.0 + guide_share * n.guide_N) / coulomb * n.screw_sliding_N;
    };
  };
  const std::vector<Row> rows{
      {{"gravity", {35.0}, {}}, [](const Nominal& n, double, const Steady&) { return n.all_N() + 35.0; }},
      {{"quadratic_drag", {2000.0}, {}},
       [](const Nominal& n, double v, const Steady&) { return n.all_N() + 2000.0 * v * std::abs(v); }},
      {{"sublinear_viscous", {0.6, 0.1}, {}},
       [](const Nominal& n, double v, const Steady&) {
         return n.all_N() + n.screw_viscous_N * (std::pow(std::abs(v) / 0.1, -0.4) - 1.0);
       }},
      {{"thermal_friction", {0.4, 30.0, 0.1}, {}},
       [](const Nominal& n, double, const Steady& s) {
         return n.all_N() - (0.4 - 0.3 * std::exp(-s.screw_work_J / 30.0)) * n.screw_viscous_N;
       }},
      {{"thermal_friction_of_all", {0.4, 30.0, 0.1}, {}},
       [](const Nominal& n, double, const Steady& s) {
         return n.all_N() - (0.4 - 0.3 * std::exp(-s.screw_work_J / 30.0)) * (n.screw_sliding_N + n.screw_viscous_N);
       }},
      {{"friction_drift", {0.5, 2.0, -0.2}, {}},
       [](const Nominal& n, double, const Steady& s) {
         return n.all_N() + (0.5 - 0.7 * std::exp(-s.time_s / 2.0)) * (n.screw_sliding_N + n.screw_viscous_N);
       }},
      {{"position_friction", {2.5, 3e4, -5e4}, {}},
       [](const Nominal& n, double v, const Steady& s) {
         return n.all_N() + s.position_m / 10.0 * (2.5 * n.screw_sliding_N + (v > 0.0 ? 3e4 : -5e4) * v);
       }},
      {{"position_friction_wave", {0.6, 2.5, 0.4, 900.0, -0.3}, {}},
       [](const Nominal& n, double v, const Steady& s) {
         const double angle = 2.0 * std::numbers::pi / 2.5 * s.position_m;
         return n.all_N() + 0.6 * std::sin(angle + 0.4) * n.screw_sliding_N + 900.0 * std::sin(angle - 0.3) * v;
       }},
      {{"load_dependent_friction", {0.15, 0.0}, {}}, loaded_by(0.0), 400.0},
      {{"load_dependent_friction", {0.15, 1.0}, {}}, loaded_by(1.0), 400.0},
      {{"direction_dependent_friction", {12.0, 200.0}, {}},
       [](const Nominal& n, double v, const Steady&) { return n.all_N() + 6.0 + 100.0 * std::abs(v); }},
      {{"cable_spring", {200.0, 0.3}, {}},
       [](const Nominal& n, double, const Steady& s) { return n.all_N() + 200.0 * (s.position_m - 0.3); }},
      {{"torque_offset", {0.02}, {}}, [](const Nominal& n, double, const Steady&) { return n.all_N() - 0.02 * rad_per_m; }},
      {{"torque_gain_error", {0.1}, {}}, [](const Nominal& n, double, const Steady&) { return n.all_N() / 1.1; }},
      {{"hidden_friction_compensation", {0.03, 1e-3, 0.0, 0.0}, {}},
       [](const Nominal& n, double v, const Steady&) { return n.all_N() - 0.03 * rad_per_m * std::tanh(v / 1e-3); }},
      {{"presliding_memory", {25.0, 1e-5}, {}},
       [](const Nominal& n, double v, const Steady&) { return n.all_N() + (v > 0.0 ? 25.0 : -25.0); }},
      {{"frictional_lag", {0.01}, {}}, [](const Nominal& n, double, const Steady&) { return n.all_N(); }},
      {{"frictional_lag_of_velocity", {0.01}, {}}, [](const Nominal& n, double, const Steady&) { return n.all_N(); }},
      {{"backlash", {1e-5, 6e7, 2e3}, {}}, [](const Nominal& n, double, const Steady&) { return n.all_N(); }},
      {{"learned_residual", {}, {{-1.0, 1.0}, {}, {}, {-8.0, 12.0}, {}, {}, {}}},
       [](const Nominal& n, double, const Steady& s) { return n.all_N() + 2.0 + 10.0 * s.position_m; }},
      {{"learned_residual", {}, {{}, {}, {0.0, 10.0}, {0.0, 30.0}, {0.0, -60.0}, {}, {}}},
       [](const Nominal& n, double v, const Steady& s) { return n.all_N() + (v > 0.0 ? 3.0 : -6.0) * s.time_s; }},
      {{"learned_residual", {}, {{-1.0, 1.0}, {}, {}, {2.0, 2.0}, {-3.0, -3.0}, {50.0, 250.0}, {-100.0, -300.0}}},
       [](const Nominal& n, double v, const Steady& s) {
         return n.all_N() + (v > 0.0 ? 2.0 + (150.0 + 100.0 * s.position_m) * v : -3.0 + (200.0 + 100.0 * s.position_m) * v);
       }},
      {{"learned_residual", {}, {{}, {0.0, 0.1}, {}, {0.0, 20.0}, {-5.0, -5.0}, {}, {}}},
       [](const Nominal& n, double v, const Steady&) { return n.all_N() + (v > 0.0 ? 200.0 * v : -5.0); }},
  };
  for (const auto& row : rows) {
    for (const double v : {0.02, 0.08, -0.05}) {
      FeedAxis axis(long_axis({row.effect}));
      const Steady found = steady(axis, v, 3.0, row.cutting_N);
      const double expected = row.expected_N(nominal(v), v, found);
      EXPECT_NEAR(found.force_N, expected, 2e-3 * std::abs(expected)) << row.effect.id << " at " << v << " m/s";
    }
  }
}

/// Force at which an axis at rest sets off, the torque raised over a tenth of a second after a dwell.
double breakaway_N(FeedAxis& axis, double dwell_s) {
  for (int i = 0; i < static_cast<int>(dwell_s / tick_s); ++i) axis.step({}, tick_s);
  const double start_m = axis.state().position_m;
  for (int i = 0; i < 200; ++i) {
    const double force_N = 2.0 * i;
    axis.step({force_N / rad_per_m}, tick_s);
    if (axis.state().position_m > start_m + 1e-4) return force_N;
  }
  return 1e9;
}

TEST(Laws, BreakawayRisesWithDwell) {
  FeedAxis without(source_axis());
  const double fresh_N = breakaway_N(without, 0.01);
  for (const double dwell_s : {0.5, 2.0, 8.0}) {
    AxisParameters p = source_axis();
    p.effects = {{"dwell_breakaway", {0.8, 2.0, 2e-3}, {}}};
    FeedAxis axis(p);
    const double rise_N = 82.0 * 0.8 * (1.0 - std::exp(-(dwell_s + 0.07) / 2.0));
    EXPECT_NEAR(breakaway_N(axis, dwell_s) - fresh_N, rise_N, 0.12 * rise_N + 3.0) << dwell_s;
  }
}

TEST(Laws, HiddenCompensationFollowsWhatTheDriveIsToldToReach) {
  AxisParameters p = source_axis();
  p.effects = {{"hidden_friction_compensation", {0.03, 1e-3, 0.0, 0.0}, {}}};
  for (const double setpoint : {-0.05, -5e-4, 0.0, 2e-3}) {
    FeedAxis axis(p);
    EXPECT_NEAR(axis.step({.setpoint_m_per_s = setpoint}, tick_s).torque_Nm, 0.03 * std::tanh(setpoint / 1e-3), 1e-12);
  }
  FeedAxis told_a_torque_alone(p);
  EXPECT_EQ(told_a_torque_alone.step({}, tick_s).torque_Nm, 0.0) << "at rest";
}

TEST(Laws, ScaleShowsTheGeometry) {
  AxisParameters p = source_axis();
  p.effects = {{"lead_error", {2e-4}, {}},
               {"cyclic_lead_error", {3e-6, 2.0, 0.5}, {}},
               {"screw_growth", {5e-5, 0.5, -0.07, 2e-5}, {}}};
  FeedAxis axis(p);
  for (int i = 0; i < 2000; ++i) {
    const auto& s = axis.step({0.3 * std::sin(0.01 * i)}, tick_s);
    const double x = s.position_m;
    const double growth = (5e-5 - 3e-5 * std::exp(-(i + 1) * tick_s / 0.5)) * (x + 0.07);
    EXPECT_NEAR(s.scale_position_m - x, 2e-4 * x + 3e-6 * std::sin(2.0 * rad_per_m * x + 0.5) + growth, 1e-8) << i;
  }
}

TEST(Laws, EncoderWobblesAndLosesCounts) {
  AxisParameters p = source_axis();
  p.effects = {{"encoder_eccentricity", {4e-6, 1.0, 0.3}, {}}};
  FeedAxis wobbling(p);
  p.effects = {{"count_loss", {7.0, 1.0, 1.0}, {}}};
  FeedAxis losing(p);
  FeedAxis plain(source_axis());
  for (int i = 0; i < 3000; ++i) {
    const AxisCommand command{0.35 * std::sin(0.008 * i)};
    const auto a = wobbling.step(command, tick_s);
    const auto b = losing.step(command, tick_s);
    const auto c = plain.step(command, tick_s);
    const double shown_m = wobbling.encoder().position_m(a.encoder_counts);
    EXPECT_NEAR(shown_m - a.position_m, 4e-6 * std::sin(rad_per_m * a.position_m + 0.3), 0.51 * 0.005 / 65536.0) << i;
    const double passes = std::floor(c.position_m / 0.005 - 1.0 / test::pi / 2.0) - std::floor(-1.0 / test::pi / 2.0);
    EXPECT_NEAR(static_cast<double>(c.encoder_counts - b.encoder_counts), 7.0 * passes,
                7.0 * (std::abs(std::remainder(c.position_m / 0.005 - 1.0 / test::pi / 2.0, 1.0)) < 1e-4 ? 1.0 : 0.0))
        << i;
  }
}

TEST(Laws, ChannelsComeLateAndScaled) {
  AxisParameters p = source_axis();
  p.effects = {{"channel_skew", {2e-3, 3e-3, 4e-3, 5e-3}, {}}, {"sensor_gain", {1.0, 0.5, 2.0, 3.0}, {}}};
  FeedAxis skewed(p);
  FeedAxis plain(source_axis());
  std::vector<AxisSignals> signals{plain.signals()};
  std::vector<ForceSignals> forces;
  for (int i = 0; i < 1500; ++i) {
    const AxisCommand command{0.3 * std::sin(0.02 * i)};
    forces.push_back(plain.force_sensors(command));
    const auto shown = skewed.force_sensors(command);
    signals.push_back(plain.step(command, tick_s));
    const auto& s = skewed.step(command, tick_s);
    if (i < 10) continue;
    const auto at = static_cast<std::size_t>(i);
    EXPECT_NEAR(shown.torque_sensor_Nm, 0.5 * forces[at - 3].torque_sensor_Nm, 1e-12) << i;
    EXPECT_NEAR(shown.force_sensor_N, 2.0 * forces[at - 4].force_sensor_N, 1e-9) << i;
    EXPECT_NEAR(s.scale_position_m, signals[at - 1].scale_position_m, 1e-15) << i;
    EXPECT_NEAR(s.metered_power_W, 3.0 * signals[at - 4].metered_power_W, 1e-9) << i;
  }
}

TEST(Laws, PowerHoldsCopperLossAndNothingThatIsClipped) {
  AxisParameters p = source_axis();
  p.effects = {{"copper_loss", {9.0}, {}}, {"regeneration_clipped", {0.75}, {}}};
  FeedAxis axis(p);
  FeedAxis plain(source_axis());
  double electrical_J = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double torque = 0.5 * std::sin(0.05 * i);
    const auto& s = axis.step({torque}, tick_s);
    const auto& b = plain.step({torque}, tick_s);
    const double with_copper = b.power_W + 9.0 * torque * torque;
    EXPECT_NEAR(s.power_W, with_copper < 0.0 ? 0.25 * with_copper : with_copper, 1e-9) << i;
    electrical_J += (s.power_W - b.power_W) * tick_s;
  }
  EXPECT_NEAR(axis.energy().motor_electrical_J - plain.energy().motor_electrical_J, electrical_J, 1e-9);
}

TEST(Laws, AWrongLeadReadsAnotherTravel) {
  AxisParameters p = source_axis();
  p.effects = {{"wrong_lead", {2.0}, {}}};
  FeedAxis axis(p);
  for (int i = 0; i < 500; ++i) axis.step({0.2}, tick_s);
  ASSERT_GT(axis.table_position_m(), 1e-3);
  EXPECT_NEAR(axis.encoder().position_m(axis.signals().encoder_counts), 0.5 * axis.table_position_m(), 1e-7);
}

TEST(Laws, AHardStopHolds) {
  AxisParameters p = source_axis();
  p.effects = {{"hard_stop", {3e-3, 1.0, 1e7, 1e4}, {}}};
  FeedAxis axis(p);
  for (int i = 0; i < 2000; ++i) axis.step({0.3}, tick_s);
  EXPECT_GT(axis.table_position_m(), 3e-3);
  EXPECT_LT(axis.table_position_m(), 3e-3 + 1.2 * 0.3 * rad_per_m / 1e7);
  for (int i = 0; i < 300; ++i) axis.step({-0.3}, tick_s);
  EXPECT_LT(axis.table_position_m(), 2e-3) << "it only pushes back";
}

}  // namespace
}  // namespace feedtwin::plant

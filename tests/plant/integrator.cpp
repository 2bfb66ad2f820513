// The plant against two general integrators of independently written equations, over ten seconds of closed-loop motion.

#include "plant/integrator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "plant/feed_axis.h"
#include "plant/parameter_table.h"
#include "tests/golden/cvode_axis.h"
#include "tests/golden/golden_motion.h"
#include "tests/golden/runge_kutta_axis.h"

namespace feedtwin::plant {
namespace {

struct Golden {
  std::vector<golden::State> states;
  int sticks = 0, reversals = 0;
};

/// Closed loop by CVODE; computed once for all tests of this file.
const Golden& by_cvode() {
  static const Golden golden = [] {
    golden::CvodeAxis axis{golden::FeedDrive{}};
    golden::GoldenController controller;
    Golden g;
    for (int i = 0; i < golden::golden_ticks; ++i) {
      axis.tick(controller.force_N(i, axis.state()[golden::position]), golden::tick_s);
      g.states.push_back(axis.state());
    }
    g.sticks = axis.sticks();
    g.reversals = axis.reversals();
    return g;
  }();
  return golden;
}

FeedAxis run_plant(Resolution resolution, std::vector<double>& error_counts) {
  FeedAxis axis(source_axis(), resolution);
  golden::GoldenController controller;
  for (std::size_t i = 0; i < golden::golden_ticks; ++i) {
    const double force_N = controller.force_N(static_cast<int>(i), axis.signals().position_m);
    axis.step({.torque_Nm = force_N / axis.model().transmission_rad_per_m}, golden::tick_s);
    error_counts.push_back(std::abs(axis.signals().position_m - by_cvode().states[i][golden::position]) / test::count_m);
  }
  return axis;
}

double largest(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

TEST(Golden, TheMotionShowsEverything) {
  const Golden& g = by_cvode();
  double fastest = 0.0;
  for (const auto& y : g.states) fastest = std::max(fastest, std::abs(y[golden::velocity]));
  EXPECT_GT(fastest, 0.255);
  EXPECT_GT(g.reversals, 20);
  EXPECT_GT(g.sticks, 100);
  RecordProperty("sticks", g.sticks);
  RecordProperty("reversals", g.reversals);
}

TEST(Golden, CvodeAgreesWithRungeKuttaAtHalfAMicrosecond) {
  golden::RungeKuttaAxis axis(golden::FeedDrive{}, 2000);
  golden::GoldenController controller;
  double worst = 0.0;
  for (std::size_t i = 0; i < golden::golden_ticks; ++i) {
    axis.tick(controller.force_N(static_cast<int>(i), axis.state()[golden::position]), golden::tick_s);
    worst = std::max(worst, std::abs(axis.state()[golden::position] - by_cvode().states[i][golden::position]));
  }
  EXPECT_LT(worst / test::count_m, 0.005);
  printf("  references differ by at most %.5f counts\n", worst / test::count_m);
}

TEST(Golden, WithinOneCount) {
  std::vector<double> error_counts;
  run_plant(one_count, error_counts);
  EXPECT_LT(largest(error_counts), 1.0);
  printf("  one_count: %.3f counts\n", largest(error_counts));
}

TEST(Golden, WithinATenthOfACount) {
  std::vector<double> error_counts;
  run_plant(tenth_of_a_count, error_counts);
  EXPECT_LT(largest(error_counts), 0.1);
  printf("  tenth_of_a_count: %.4f counts\n", largest(error_counts));
}

TEST(Golden, EnergyByComponentWithinATenthOfAPercent) {
  std::vector<double> error_counts;
  const FeedAxis axis = run_plant(one_count, error_counts);
  const AxisEnergy e = axis.energy();
  const golden::State& y = by_cvode().states.back();
  const auto kinetic_J = [v = y[golden::velocity]](double mass_kg) { return 0.5 * mass_kg * v * v; };
  EXPECT_NEAR(e.motor_electrical_J, y[golden::electrical_loss], 1e-3 * y[golden::electrical_loss]);
  EXPECT_NEAR(e.motor_mechanical_J - kinetic_J(axis.model().motor_mass_kg), y[golden::motor_loss],
              1e-3 * y[golden::motor_loss]);
  EXPECT_NEAR(e.ball_screw_J - kinetic_J(axis.model().screw_mass_kg), y[golden::screw_work], 1e-3 * y[golden::screw_work]);
  EXPECT_NEAR(e.guide_J - kinetic_J(axis.model().table_mass_kg), y[golden::guide_work], 1e-3 * y[golden::guide_work]);
  EXPECT_LT(e.balance_error(), 1e-3);
}

}  // namespace
}  // namespace feedtwin::plant

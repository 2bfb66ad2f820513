// Friction that an axis file has the same in both directions, and the machine has not.

#include "tools/diagnose/by_direction.h"

#include <gtest/gtest.h>

#include "tests/support/made_case.h"
#include "tests/tools/diagnose/fitted_runs.h"
#include "tools/diagnose/judge.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

plant::AxisParameters same_both_ways(plant::AxisParameters axis) {
  const auto same = [](auto& both) { both.neg = both.pos = 0.5 * (both.pos + both.neg); };
  same(axis.motor.damping_Nms), same(axis.motor.coulomb_N);
  for (auto* contact : {&axis.ball_screw, &axis.guide})
    same(contact->coulomb_N), same(contact->static_N), same(contact->stribeck_m_per_s), same(contact->viscous_Ns_per_m);
  return axis;
}

/// What is told of a machine by whoever has this axis file.
std::optional<NamedEffect> told(const plant::AxisParameters& truth, const plant::AxisParameters& nominal, bool sensors) {
  std::vector<tools::Recording> runs;
  for (const char* motion : {"sine", "s_curve"}) {
    tests::MadeRun made{
        .motion = motion, .duration_s = 6.0, .sensors = sensors, .torque_noise_Nm = 5e-4, .force_noise_N = 0.05};
    made.settings.speed_m_per_s = 0.08, made.settings.amplitude_m = 0.02;
    runs.push_back(tests::make_recording(truth, made));
  }
  const tests::FittedRuns fitted(runs, nominal);
  return difference_by_direction(fitted.fitter, fitted.fit, robust_covariance(fitted.model, fitted.fit));
}

TEST(ByDirection, ADifferenceIsToldToWhoHasOneNumberForBoth) {
  auto truth = same_both_ways(plant::source_axis());
  truth.ball_screw.coulomb_N = {truth.ball_screw.coulomb_N.pos + 6.0, truth.ball_screw.coulomb_N.neg - 6.0};
  truth.ball_screw.static_N = {truth.ball_screw.static_N.pos + 6.0, truth.ball_screw.static_N.neg - 6.0};
  const auto found = told(truth, same_both_ways(plant::source_axis()), true);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->hypothesis->id, "direction_dependent_friction");
  EXPECT_TRUE(found->alternatives.empty()) << "a force sensor tells friction from a force on the table";
  EXPECT_LT(found->p_false_alarm, 1e-3);
  const Estimate coulomb = found->parameters.front().second;
  EXPECT_LT(coulomb.low, 12.0);
  EXPECT_GT(coulomb.high, 12.0);
  EXPECT_LT(coulomb.high - coulomb.low, 2.0);
  const auto without_sensors = told(truth, same_both_ways(plant::source_axis()), false);
  ASSERT_TRUE(without_sensors.has_value());
  EXPECT_EQ(without_sensors->alternatives, (std::vector<std::string>{"torque_offset", "gravity"}));
}

// A torque's offset is in the motor's equation alone, a weight's share in the table's.
TEST(ByDirection, ASensorTellsWhichConstantForceItMayBe) {
  const auto nominal = same_both_ways(plant::source_axis());
  auto of_motor = nominal, of_guide = nominal;
  of_motor.motor.coulomb_N = {nominal.motor.coulomb_N.pos + 6.0, nominal.motor.coulomb_N.neg - 6.0};
  of_guide.guide.coulomb_N = {nominal.guide.coulomb_N.pos + 6.0, nominal.guide.coulomb_N.neg - 6.0};
  of_guide.guide.static_N = {nominal.guide.static_N.pos + 6.0, nominal.guide.static_N.neg - 6.0};
  for (const auto& [truth, force] : {std::pair{of_motor, "torque_offset"}, {of_guide, "gravity"}}) {
    const auto found = told(truth, nominal, true);
    ASSERT_TRUE(found.has_value()) << force;
    EXPECT_EQ(found->alternatives, std::vector<std::string>{force});
  }
}

TEST(ByDirection, ADifferenceOfTwoPerCentIsTold) {
  const auto nominal = same_both_ways(plant::source_axis());
  const double coulomb_N = nominal.motor.coulomb_N.pos + nominal.ball_screw.coulomb_N.pos + nominal.guide.coulomb_N.pos;
  for (const double share : {0.015, 0.025}) {
    auto truth = nominal;
    for (auto* friction_N : {&truth.ball_screw.coulomb_N, &truth.ball_screw.static_N})
      friction_N->pos += 0.5 * share * coulomb_N, friction_N->neg -= 0.5 * share * coulomb_N;
    EXPECT_EQ(told(truth, nominal, true).has_value(), share > 0.02) << share;
  }
}

TEST(ByDirection, ItIsEnoughThatTheFileHasOneNumberOfTheComponentThatDiffers) {
  auto nominal = same_both_ways(plant::source_axis());
  nominal.guide.coulomb_N.pos *= 0.8, nominal.guide.viscous_Ns_per_m.neg *= 1.1;
  auto truth = nominal;
  EXPECT_FALSE(told(truth, nominal, true).has_value());
  for (auto* friction_N : {&truth.ball_screw.coulomb_N, &truth.ball_screw.static_N})
    friction_N->pos += 6.0, friction_N->neg -= 6.0;
  const auto found = told(truth, nominal, true);
  ASSERT_TRUE(found.has_value());
  const Estimate coulomb = found->parameters.front().second;
  EXPECT_LT(coulomb.low, 12.0);
  EXPECT_GT(coulomb.high, 12.0);
  EXPECT_LT(coulomb.high - coulomb.low, 2.0);
}

TEST(ByDirection, NothingIsToldOfAMachineThatIsTheSameBothWaysOrToWhoKnows) {
  auto off = same_both_ways(plant::source_axis());
  off.ball_screw.coulomb_N.pos *= 1.08, off.ball_screw.coulomb_N.neg *= 1.08;
  off.motor.inertia_kgm2 *= 0.95;
  EXPECT_FALSE(told(off, same_both_ways(plant::source_axis()), true).has_value());
  auto truth = plant::source_axis();
  truth.ball_screw.coulomb_N.pos *= 1.1;
  EXPECT_FALSE(told(truth, plant::source_axis(), true).has_value());
}

}  // namespace
}  // namespace feedtwin

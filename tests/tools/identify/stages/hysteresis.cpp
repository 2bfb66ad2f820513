#include "tools/identify/stages/hysteresis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "plant/parameter_table.h"
#include "tests/support/testbed.h"
#include "tools/identify/stages/by_genetic.h"
#include "tools/identify/stages/electrical_loss.h"

namespace feedtwin::tools {
namespace {

/// A slow sine of a few bristle lengths under one contact's law, with the force that it gives.
ComponentForces loops(const plant::LugreParameters& friction, double mass_kg) {
  ComponentForces run;
  run.sample_s = 1e-3;
  const double amplitude_m = 3.0 * friction.static_N.pos / friction.stiffness_N_per_m, rate = 12.0;
  double travelled = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const double t = 1e-3 * i, v = amplitude_m * rate * std::sin(rate * t);
    run.position_m.push_back(amplitude_m * (1.0 - std::cos(rate * t)));
    travelled = i > 0 && v * run.velocity_m_per_s.back() <= 0.0 ? 0.0 : travelled + std::abs(v) * 1e-3;
    run.velocity_m_per_s.push_back(v);
    run.acceleration_m_per_s2.push_back(amplitude_m * rate * rate * std::cos(rate * t));
    run.since_reversal_m.push_back(travelled);
  }
  run.guide_N = HysteresisCost::model_N(run, mass_kg, friction);
  return run;
}

TEST(Hysteresis, GivesTheBristleBackFromAWrongStart) {
  std::mt19937_64 random(95);
  for (int round = 0; round < 20; ++round) {
    auto truth = plant::source_axis().guide;
    const auto factor = [&random](double spread) {
      return std::exp(std::uniform_real_distribution<double>(-std::log(spread), std::log(spread))(random));
    };
    truth.stiffness_N_per_m *= factor(5.0);
    truth.damping_Ns_per_m *= factor(3.0);
    const std::vector runs{loops(truth, 4.0)};
    auto start = truth;
    start.stiffness_N_per_m *= factor(3.0);
    const auto fit = fit_hysteresis(runs, &ComponentForces::guide_N, 4.0, start);
    ASSERT_TRUE(fit) << round;
    EXPECT_NEAR(fit->stiffness_N_per_m, truth.stiffness_N_per_m, 2e-3 * truth.stiffness_N_per_m) << round;
    EXPECT_NEAR(fit->damping_Ns_per_m, truth.damping_Ns_per_m, 0.05 * truth.damping_Ns_per_m) << round;
  }
}

TEST(Hysteresis, TheGeneticAlgorithmIsNoBetter) {
  const auto truth = plant::source_axis().guide;
  std::vector runs{loops(truth, 4.0)};
  std::mt19937_64 random(96);
  std::normal_distribution<double> noise_N(0.0, 0.2);
  for (double& force : runs[0].guide_N) force += noise_N(random);
  const auto fit = fit_hysteresis(runs, &ComponentForces::guide_N, 4.0, truth);
  const auto genetic =
      fit_hysteresis_by_genetic(runs, &ComponentForces::guide_N, 4.0, truth, {.population = 40, .most_generations = 60});
  ASSERT_TRUE(fit && genetic);
  EXPECT_GE(genetic->rms_N, fit->rms_N * (1.0 - 1e-6));
  EXPECT_LT(genetic->rms_N, 1.5 * fit->rms_N);
}

TEST(Hysteresis, AsksForReversals) {
  auto run = loops(plant::source_axis().guide, 4.0);
  for (double& travelled : run.since_reversal_m) travelled = 1.0;
  EXPECT_FALSE(fit_hysteresis(std::vector{run}, &ComponentForces::guide_N, 4.0, plant::source_axis().guide));
}

// The meter's windows against the law: constant speeds are not needed.
TEST(ElectricalLoss, ComesBackFromAnyMotion) {
  const auto truth = plant::source_axis();
  const std::vector runs{tests::make_recording(
      truth, {.motion = "sine", .settings = {.amplitude_m = 0.02, .speed_m_per_s = 0.08}, .duration_s = 8.0})};
  const auto fit = fit_electrical_loss(runs, truth);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->idle_W, 0.25, 0.01);
  EXPECT_NEAR(fit->quadratic_Ws2_per_m2.pos, 1370.0, 5.0);
  EXPECT_NEAR(fit->quadratic_Ws2_per_m2.neg, 1610.0, 5.0);
  EXPECT_NEAR(fit->linear_Ws_per_m.neg, 18.1, 0.5);
  auto without = runs;
  without[0].channels.erase("power_W");
  EXPECT_FALSE(fit_electrical_loss(without, truth));
}

}  // namespace
}  // namespace feedtwin::tools

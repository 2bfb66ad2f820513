#include "tools/identify/stages/inverse_lugre.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "plant/parameter_table.h"
#include "tests/support/made_case.h"

namespace feedtwin::tools {
namespace {

ComponentForces eight_seconds() {
  const auto axis = plant::source_axis();
  const auto recording =
      tests::make_recording(axis, {.settings = {.amplitude_m = 0.01, .speed_m_per_s = 0.03}, .duration_s = 8.0});
  return component_forces(recording, axis.axis.lead_m);
}

// Whatever the start, one optimum; nothing near it or drawn at random is better.
TEST(InverseLugre, FindsTheSameOptimumFromAnyStart) {
  const std::vector runs{eight_seconds()};
  const InverseLugre model(runs);
  const auto best = model.fit();
  ASSERT_TRUE(best);
  EXPECT_NEAR(model.cost(*best), best->cost, 1e-6 * best->cost);
  std::mt19937_64 random(91);
  const auto factor = [&random](double spread) {
    return std::exp(std::uniform_real_distribution<double>(-std::log(spread), std::log(spread))(random));
  };
  for (int start = 0; start < 10; ++start) {
    const auto again = model.fit({2e-6 * factor(10.0), 1.0 + 0.2 * factor(5.0), 1e-3 * factor(5.0)});
    ASSERT_TRUE(again) << start;
    EXPECT_LT(again->cost, best->cost * (1.0 + 1e-3)) << start;
  }
  for (int trial = 0; trial < 200; ++trial) {
    InverseLugreFit other = *best;
    for (double* value : {&other.mass_kg, &other.coulomb_N, &other.static_N, &other.stribeck_m_per_s,
                          &other.viscous_Ns_per_m, &other.stiffness_N_per_m, &other.damping_Ns_per_m})
      *value *= factor(1.02);
    ASSERT_GT(model.cost(other), best->cost * (1.0 - 1e-3)) << trial;
  }
}

TEST(InverseLugre, TellsTheAxisAsAWhole) {
  const std::vector runs{eight_seconds()};
  const auto fit = InverseLugre(runs).fit();
  ASSERT_TRUE(fit);
  const auto p = plant::source_axis();
  const double k = 2.0 * 3.14159265358979 / p.axis.lead_m;
  const double coulomb_N = 0.5 * (p.motor.coulomb_N.pos + p.motor.coulomb_N.neg + p.ball_screw.coulomb_N.pos +
                                  p.ball_screw.coulomb_N.neg + p.guide.coulomb_N.pos + p.guide.coulomb_N.neg);
  EXPECT_NEAR(fit->mass_kg, (p.motor.inertia_kgm2 + p.ball_screw_inertia_kgm2) * k * k + p.guide_mass_kg, 7.0)
      << "one friction for both directions takes some of it";
  EXPECT_NEAR(fit->coulomb_N, coulomb_N, 0.05 * coulomb_N);
  EXPECT_FALSE(InverseLugre(std::vector<ComponentForces>{}).fit()) << "nothing to go by";
}

}  // namespace
}  // namespace feedtwin::tools

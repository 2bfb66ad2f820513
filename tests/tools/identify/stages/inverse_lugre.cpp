#include "tools/identify/stages/inverse_lugre.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "plant/lugre.h"
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
  EXPECT_NEAR(model.cost(*best), best->cost, 1e-8 * best->cost) << "the plant's step, tick by tick";
  std::mt19937_64 random(91);
  const auto factor = [&random](double spread) {
    return std::exp(std::uniform_real_distribution<double>(-std::log(spread), std::log(spread))(random));
  };
  int passes = 0;
  for (int start = 0; start < 100; ++start) {
    const auto again = model.fit({2e-6 * factor(10.0), 1.0 + 0.2 * factor(5.0), 1e-3 * factor(5.0)});
    ASSERT_TRUE(again) << start;
    EXPECT_NEAR(again->cost, best->cost, 1e-6 * best->cost) << start;
    passes += again->passes;
  }
  EXPECT_LT(passes, 1000) << "of 100 starts";
  for (int trial = 0; trial < 200; ++trial) {
    InverseLugreFit other = *best;
    for (double* value : {&other.mass_kg, &other.coulomb_N, &other.static_N, &other.stribeck_m_per_s,
                          &other.viscous_Ns_per_m, &other.stiffness_N_per_m, &other.damping_Ns_per_m})
      *value *= factor(1.02);
    other.static_N = std::max(other.static_N, other.coulomb_N);  // breakaway never below Coulomb
    ASSERT_GT(model.cost(other), best->cost * (1.0 - 1e-6)) << trial;
  }
}

/// What is not as in the record's first quarter.
struct Later {
  double static_N, stiffness_N_per_m;
};

/// A sine of so many periods, with the forces of 60 kg on one contact.
ComponentForces made_of(int periods, double amplitude_m, const Later& later) {
  constexpr double sample_s = 1e-3, rate = 4.0;
  const auto rows = static_cast<std::size_t>(periods * 2.0 * 3.14159265358979 / rate / sample_s);
  std::mt19937_64 random(92);
  std::normal_distribution<double> noise_N(0.0, 1.0);
  ComponentForces made;
  made.sample_s = sample_s;
  for (std::size_t i = 0; i < rows; ++i)
    made.position_m.push_back(amplitude_m * (1.0 - std::cos(rate * sample_s * static_cast<double>(i))));
  made.total_N.assign(rows, 0.0);
  double z_m = 0.0;
  for (std::size_t i = 1; i + 2 < rows; ++i) {
    const auto& x = made.position_m;
    const bool first = 4 * i < rows;
    const double v = (x[i + 1] - x[i]) / sample_s, sign = v < 0.0 ? -1.0 : 1.0;
    const double stiffness = first ? 4e7 : later.stiffness_N_per_m, static_N = first ? 100.0 : later.static_N;
    const auto step = plant::lugre_step<double>({stiffness, 1.0 / stiffness, 2e3}, {80.0, static_N - 80.0, 1e3, 900.0}, sign,
                                                sign * v, z_m, sample_s, 1.0 / sample_s);
    z_m = step.bristle_m;
    const double a = (x[i + 2] - x[i + 1] - x[i] + x[i - 1]) / (2.0 * sample_s * sample_s);
    made.total_N[i] = 60.0 * a + step.force_N + 4.0 + noise_N(random);
  }
  return made;
}

/// No number by itself can be moved for the better.
void expect_optimum(const InverseLugre& model, const InverseLugreFit& best) {
  for (double InverseLugreFit::* number :
       {&InverseLugreFit::mass_kg, &InverseLugreFit::coulomb_N, &InverseLugreFit::static_N,
        &InverseLugreFit::stribeck_m_per_s, &InverseLugreFit::viscous_Ns_per_m, &InverseLugreFit::stiffness_N_per_m,
        &InverseLugreFit::damping_Ns_per_m}) {
    for (const double factor : {0.99, 0.999, 1.001, 1.01}) {
      InverseLugreFit other = best;
      other.*number *= factor;
      EXPECT_GT(model.cost(other), best.cost * (1.0 - 1e-7)) << factor;
    }
  }
}

// A Stribeck rise that the record tells: the valley between rise and velocity is narrow and bent, and another one lies where
// a long bristle stands in for the rise.
TEST(InverseLugre, FindsTheSameStribeckRiseFromNearlyAnyStart) {
  const std::vector runs{made_of(5, 0.001, {100.0, 4e7})};
  const InverseLugre model(runs);
  const auto best = model.fit();
  ASSERT_TRUE(best);
  expect_optimum(model, *best);
  EXPECT_NEAR(best->static_N, 100.0, 1.5);
  EXPECT_NEAR(best->stribeck_m_per_s, 1e-3, 1e-4);
  std::mt19937_64 random(93);
  const auto factor = [&random](double spread) {
    return std::exp(std::uniform_real_distribution<double>(-std::log(spread), std::log(spread))(random));
  };
  int found = 0;
  for (int start = 0; start < 100; ++start) {
    const auto again = model.fit({2e-6 * factor(10.0), 1.0 + 0.2 * factor(5.0), 1e-3 * factor(5.0)});
    ASSERT_TRUE(again) << start;
    EXPECT_GT(again->cost, best->cost * (1.0 - 1e-6)) << start;
    found += again->cost < best->cost * (1.0 + 1e-6) ? 1 : 0;
  }
  EXPECT_GE(found, 95) << "of 100";
}

// Starts that are no friction at all come back within the bounds; none at all is no answer.
TEST(InverseLugre, StartsFromWherever) {
  const std::vector runs{made_of(5, 0.001, {100.0, 4e7})};
  const InverseLugre model(runs);
  const auto best = model.fit();
  ASSERT_TRUE(best);
  for (const InverseLugreStart& from :
       {InverseLugreStart{1e-12, 1.0, 1e-3}, InverseLugreStart{1.0, 0.5, 1e3}, InverseLugreStart{2e-6, 1e6, 1e-12}}) {
    const auto fit = model.fit(from);
    ASSERT_TRUE(fit) << from.bristle_length_m;
    EXPECT_LE(fit->cost, model.cost({60.0, 80.0, 80.0, 1e-3, 900.0, 4e7, 2e3, 4.0, 0.0, 0}))
        << "at least as good as no rise";
    EXPECT_GE(fit->static_N, fit->coulomb_N);
  }
  EXPECT_FALSE(model.fit({std::nan(""), 1.3, 1e-3}));
}

// The first quarter is not like the rest.
TEST(InverseLugre, GoesByAllOfTheRecord) {
  const std::vector same{made_of(12, 0.01, {100.0, 4e7})}, changed{made_of(12, 0.01, {110.0, 2e7})};
  const InverseLugre alike(same), model(changed);
  const auto as_led = alike.fit(), best = model.fit();
  ASSERT_TRUE(as_led && best);
  expect_optimum(alike, *as_led);
  expect_optimum(model, *best);
  EXPECT_NEAR(as_led->stiffness_N_per_m, 4e7, 4e6);
  EXPECT_LT(best->stiffness_N_per_m, 3e7);
}

// One run; one beside another; one too short for a block.
TEST(InverseLugre, TakesRunsOfAnyLength) {
  const Later same{100.0, 4e7};
  ComponentForces brief = made_of(1, 0.01, same);
  for (auto* column : {&brief.position_m, &brief.total_N}) column->resize(40);
  for (const auto& runs : {std::vector{made_of(1, 0.01, same)}, std::vector{made_of(2, 0.002, same), brief},
                           std::vector{made_of(1, 0.01, same), made_of(9, 0.001, same), brief}}) {
    const InverseLugre model(runs);
    const auto fit = model.fit();
    ASSERT_TRUE(fit) << runs.size();
    EXPECT_NEAR(model.cost(*fit), fit->cost, 1e-8 * fit->cost) << runs.size();
    expect_optimum(model, *fit);
  }
  EXPECT_FALSE(InverseLugre(std::vector{brief}).fit()) << "too few ticks";
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

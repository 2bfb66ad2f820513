// A force sensor's gain that mass and friction of the table make up for, all of them, is named; numbers that are off each by
// itself are not.

#include "tools/diagnose/forward/gain_in_numbers.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "tests/support/made_case.h"
#include "tests/tools/diagnose/fitted_runs.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

/// The table's numbers that are known to a tenth, each times what its turn gives.
template <class Factor>
plant::AxisParameters with_table(plant::AxisParameters axis, Factor times) {
  axis.guide_mass_kg *= times();
  for (auto* number : {&axis.guide.coulomb_N, &axis.guide.static_N, &axis.guide.viscous_Ns_per_m}) {
    number->pos *= times();
    number->neg *= times();
  }
  return axis;
}

tests::MadeRun moves() {
  tests::MadeRun run{.motion = "sine", .duration_s = 5.0, .torque_noise_Nm = 5e-4, .force_noise_N = 0.05};
  run.settings.speed_m_per_s = 0.12, run.settings.amplitude_m = 0.01;
  return run;
}

class OfTheTable : public testing::Test {
 protected:
  tests::FittedRuns fitted_{{tests::make_recording(plant::source_axis(), moves())}, plant::source_axis(), 1};
  CommonShift shift(const plant::AxisParameters& axis) { return common_shift(fitted_.fitter, axis); }
};

TEST_F(OfTheTable, AllNumbersOffByOneShareHaveAShift) {
  for (const double factor : {0.75, 0.88, 1.12, 1.3}) {
    const auto found = shift(with_table(plant::source_axis(), [&] { return factor; }));
    EXPECT_NEAR(found.factor, factor, 1e-9);
    EXPECT_TRUE(found.of_all_together);
  }
  EXPECT_FALSE(shift(with_table(plant::source_axis(), [] { return 1.08; })).of_all_together) << "within a tolerance";
}

TEST_F(OfTheTable, CoulombAndViscousFrictionThatMakeUpForEachOtherDoNotHideIt) {
  auto axis = with_table(plant::source_axis(), [] { return 0.7; });
  const double at_m_per_s = 0.06, less_N = 0.5;
  for (auto side : {&plant::Directional::pos, &plant::Directional::neg})
    axis.guide.coulomb_N.*side -= less_N, axis.guide.viscous_Ns_per_m.*side += less_N / at_m_per_s;
  const auto found = shift(axis);
  EXPECT_NEAR(found.factor, 0.7, 0.02);
  EXPECT_TRUE(found.of_all_together);
}

TEST_F(OfTheTable, FrictionOrMassByItselfHasNone) {
  auto friction = with_table(plant::source_axis(), [] { return 1.3; }), mass = plant::source_axis();
  friction.guide_mass_kg = plant::source_axis().guide_mass_kg;
  mass.guide_mass_kg *= 1.8;
  EXPECT_FALSE(shift(friction).of_all_together) << "a guide that is cold";
  EXPECT_FALSE(shift(mass).of_all_together) << "a table that is heavier";
  mass.guide_mass_kg = 1.15 * plant::source_axis().guide_mass_kg;
  mass.guide.coulomb_N.pos *= 3.0;
  EXPECT_FALSE(shift(mass).of_all_together) << "off by shares that have nothing in common";
}

TEST_F(OfTheTable, NumbersOffEachByItselfHaveNone) {
  std::mt19937 dice(4);
  std::uniform_real_distribution<double> off(0.03, 0.1);
  for (int i = 0; i < 20'000; ++i) {
    const auto axis = with_table(plant::source_axis(), [&] { return 1.0 + (dice() % 2 == 0 ? 1.0 : -1.0) * off(dice); });
    ASSERT_FALSE(shift(axis).of_all_together) << i;
  }
}

TEST(CommonShift, StandsForAGainOfItsSizeAndNoOther) {
  for (const double factor : {0.7, 0.87, 1.14, 1.4}) {
    const CommonShift shift{.factor = factor, .fall = 1.0, .of_all_together = true};
    for (const double power : {0.6, 1.0, 1.5}) EXPECT_TRUE(shift.stands_for(std::pow(factor, power))) << factor << power;
    for (const double power : {-1.0, 0.0, 0.3, 2.5})
      EXPECT_FALSE(shift.stands_for(std::pow(factor, power))) << factor << power;
  }
}

TEST_F(OfTheTable, WhatIsTakenFromTheTableIsTheScrews) {
  constexpr double times = 1.25;
  const auto before = plant::source_axis(), after = with_table_less(before, times);
  const double lead_per_rad = before.axis.lead_m / 6.283185307179586;
  EXPECT_NEAR(after.guide_mass_kg * times, before.guide_mass_kg, 1e-12);
  EXPECT_NEAR(after.guide.viscous_Ns_per_m.neg * times, before.guide.viscous_Ns_per_m.neg, 1e-9);
  const auto inertia = [&](const plant::AxisParameters& axis) {
    return axis.ball_screw_inertia_kgm2 + axis.guide_mass_kg * lead_per_rad * lead_per_rad;
  };
  EXPECT_NEAR(inertia(after), inertia(before), 1e-15);
  const auto both = [](const plant::AxisParameters& axis, plant::Directional plant::LugreParameters::* number) {
    return std::array{(axis.guide.*number).pos + (axis.ball_screw.*number).pos,
                      (axis.guide.*number).neg + (axis.ball_screw.*number).neg};
  };
  for (auto number :
       {&plant::LugreParameters::coulomb_N, &plant::LugreParameters::static_N, &plant::LugreParameters::viscous_Ns_per_m}) {
    EXPECT_NEAR(both(after, number)[0], both(before, number)[0], 1e-9);
    EXPECT_NEAR(both(after, number)[1], both(before, number)[1], 1e-9);
  }
  EXPECT_NEAR(after.guide.stiffness_N_per_m + after.ball_screw.stiffness_N_per_m,
              before.guide.stiffness_N_per_m + before.ball_screw.stiffness_N_per_m, 1e-3);
}

struct Asked {
  Fit fit;
  SearchResult found;
  std::optional<Ruling> settled;
};

/// Of an axis whose file is right, but for the screw's friction, and whose force sensor shows so many times the truth.
Asked asked_of(double gain) {
  auto truth = plant::source_axis(), nominal = truth;
  truth.effects = {tests::effect("sensor_gain", {{"force_sensor_gain", gain}, {"torque_sensor_gain", 1.0}})};
  nominal.ball_screw.coulomb_N.pos *= 1.05;
  tools::Case data = tests::short_case(truth, nominal);
  data.fit = {tests::make_recording(truth, moves())};
  const tests::FittedRuns fitted(data.fit, nominal);
  Asked asked{fitted.fit, {}, {}};
  asked.found.whitening = fitted.whitening;
  const ForwardModel forward(data.fit, data);
  asked.settled =
      ask_for_gain_in_numbers(forward, fitted.fitter, asked.found, asked.fit, std::nullopt, [](std::string_view) {});
  return asked;
}

TEST(GainInNumbers, IsNamedAndTheNumbersAreTheFilesAgain) {
  const auto asked = asked_of(1.2);
  ASSERT_EQ(asked.found.found.size(), 1U);
  EXPECT_TRUE(asked.found.found[0].by_common_shift);
  EXPECT_LT(asked.found.found[0].p_false_alarm, 0.01);
  ASSERT_TRUE(asked.settled.has_value());
  const auto& gain = asked.settled->model.effects.back();
  EXPECT_EQ(gain.hypothesis->id, "sensor_gain");
  EXPECT_NEAR(gain.q[1], 0.2, 0.03);
  EXPECT_NEAR(asked.settled->model.axis.guide_mass_kg, plant::source_axis().guide_mass_kg,
              0.03 * plant::source_axis().guide_mass_kg);
  EXPECT_EQ(asked.fit.model.effects.size(), 1U);
}

TEST(GainInNumbers, ARightSensorIsLeftAlone) {
  const auto asked = asked_of(1.0);
  EXPECT_TRUE(asked.found.found.empty());
  EXPECT_TRUE(asked.fit.model.effects.empty());
  EXPECT_FALSE(asked.settled.has_value());
}

}  // namespace
}  // namespace feedtwin

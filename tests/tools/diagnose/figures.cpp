// Figures of the inverse model: of the model and the runs alone, whatever the axis file said.

#include "tools/diagnose/figures.h"

#include <gtest/gtest.h>

#include "tests/support/made_case.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

/// The truth's figures on its own runs, beside an axis file whose masses are so many times too large.
struct Figures {
  double weighted, nrmse, force_error;
};

plant::AxisParameters heavier(plant::AxisParameters axis, double times) {
  axis.motor.inertia_kgm2 *= times;
  axis.ball_screw_inertia_kgm2 *= times;
  axis.guide_mass_kg *= times;
  return axis;
}

Figures beside_file(const tools::Case& data, const plant::AxisParameters& truth, double times) {
  const plant::AxisParameters file = heavier(truth, times);
  const InverseModel runs(make_tracks(data.fit, file), file);
  const Candidate model{truth, {}};
  const Followed at = followed(runs, model);
  return {runs.residual(truth, {}).norm(), nrmse(at).at("torque_cmd_Nm"), relative_force_error(at)};
}

TEST(InverseFigures, DoNotDependOnTheAxisFile) {
  const auto truth = plant::source_axis();
  const auto data = tests::short_case(truth, truth);
  const auto right = beside_file(data, truth, 1.0), heavy = beside_file(data, truth, 1.5);
  ASSERT_GT(heavy.weighted, 1.05 * right.weighted) << "the fit's rows carry a weight";
  EXPECT_NEAR(heavy.nrmse / right.nrmse, 1.0, 1e-9);
  EXPECT_NEAR(heavy.force_error / right.force_error, 1.0, 1e-9);
}

TEST(InverseFigures, TellAWrongMass) {
  const auto truth = plant::source_axis();
  const auto data = tests::short_case(truth, truth);
  const InverseModel runs(make_tracks(data.fit, truth), truth);
  const Candidate right{truth, {}}, wrong{heavier(truth, 0.7), {}};
  EXPECT_GT(relative_force_error(followed(runs, wrong)), 2.0 * relative_force_error(followed(runs, right)));
}

TEST(InverseFigures, WhatTheEffectsMakeIsTheirsWhateverTheNumbers) {
  const auto truth = plant::source_axis();
  const auto data = tests::short_case(truth, truth);
  const InverseModel runs(make_tracks(data.fit, truth), truth);
  const Active cogging{&hypothesis("cogging"), {0.02, 0.0, 8.0}};
  const Candidate with{truth, {cogging}}, wrong{heavier(truth, 1.5), {cogging}}, none{truth, {}};
  const double made = made_by_effects(followed(runs, with)).at("torque_cmd_Nm");
  EXPECT_NEAR(made, nrmse(followed(runs, with)).at("torque_cmd_Nm"), 0.05 * made) << "the model is right but for it";
  EXPECT_NEAR(made_by_effects(followed(runs, wrong)).at("torque_cmd_Nm"), made, 0.01 * made);
  EXPECT_EQ(made_by_effects(followed(runs, none)).at("torque_cmd_Nm"), 0.0);
}

TEST(InverseFigures, OfARunTooShortForARowAreNone) {
  const auto truth = plant::source_axis();
  auto data = tests::short_case(truth, truth);
  data.fit.resize(1);
  for (auto& [name, values] : data.fit.front().channels) values.resize(40);
  const InverseModel runs(make_tracks(data.fit, truth), truth);
  const Candidate model{truth, {}};
  EXPECT_EQ(relative_force_error(followed(runs, model)), 0.0);
}

}  // namespace
}  // namespace feedtwin

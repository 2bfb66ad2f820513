// The second engine: what it makes of runs whose truth is known.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "plant/effects/registry.h"
#include "tests/support/made_case.h"
#include "tests/tools/diagnose/named_effect.h"
#include "tools/diagnose/forward/confirm.h"
#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/forward/pictures.h"
#include "tools/diagnose/forward/polish.h"
#include "tools/diagnose/forward/sizes.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;
using tools::Case;

constexpr double amplitude_Nm = 0.01;

Active cogging(double sine_Nm) {
  return {&hypothesis("cogging"), {sine_Nm, 0.0, 8.0}};
}

/// Runs of the source's axis, with cogging or without, under a nominal model that is some per cent off.
Case made_case(double sine_Nm) {
  const auto truth =
      extended({plant::source_axis(), sine_Nm == 0.0 ? std::vector<Active>{} : std::vector{cogging(sine_Nm)}}).common;
  auto nominal = plant::source_axis();
  nominal.motor.inertia_kgm2 *= 1.05;
  nominal.ball_screw.coulomb_N.pos *= 0.94;
  return tests::short_case(truth, nominal);
}

TEST(ForwardModel, TheAxisThatMadeARunLeavesTheNoiseFloorAndAWrongOneMore) {
  const Case data = made_case(0.0);
  const ForwardModel forward(data.fit, data);
  const auto truth = plant::source_axis();
  const double left = forward.nrmse(truth).at("torque_cmd_Nm"), floor = forward.noise_floor(truth).at("torque_cmd_Nm");
  EXPECT_LT(left, 1.5 * floor);
  EXPECT_GT(left, 0.5 * floor);
  EXPECT_GT(forward.nrmse(data.axis).at("torque_cmd_Nm"), 3.0 * floor);
}

// Axes that are alike are simulated once, so this does not hang on who asks how often.
TEST(ForwardModel, CountsWhatItSimulates) {
  const Case data = made_case(0.0);
  const auto axis = plant::source_axis();
  auto other = axis;
  other.motor.inertia_kgm2 *= 1.1;
  const auto one_run = static_cast<std::uint64_t>(data.fit.front().size());
  const ForwardModel forward(data.fit, data, 2 * one_run);
  (void)forward.simulate(forward.runs().front(), {axis, axis});
  EXPECT_EQ(forward.simulated_samples(), one_run);
  EXPECT_FALSE(forward.spent());
  (void)forward.simulate(forward.runs().front(), {axis, other});
  EXPECT_EQ(forward.simulated_samples(), 3 * one_run);
  EXPECT_TRUE(forward.spent());
}

// A step of a fit may ask for anything: an axis that is no number is like no other, and takes none of their results.
TEST(ForwardModel, SimulatesEqualAxesOnceAndEachAsAlone) {
  const Case data = made_case(0.0);
  const ForwardModel forward(data.fit, data);
  auto heavy = data.axis, nothing = data.axis;
  heavy.guide_mass_kg *= 1.5;
  nothing.axis.end_stop_stiffness_N_per_m = std::numeric_limits<double>::quiet_NaN();  // left out of these simulations
  const auto& run = forward.runs().front();
  const auto all = forward.simulate(run, {data.axis, nothing, heavy, data.axis, nothing});
  ASSERT_EQ(all.size(), 5U);
  EXPECT_EQ(all[0].torque_Nm, forward.simulate(run, {data.axis}).front().torque_Nm);
  EXPECT_EQ(all[2].torque_Nm, forward.simulate(run, {heavy}).front().torque_Nm);
  EXPECT_EQ(all[3].torque_Nm, all[0].torque_Nm);
  EXPECT_NE(all[2].torque_Nm, all[0].torque_Nm);
  for (const std::size_t i : {1U, 4U}) EXPECT_EQ(all[i].torque_Nm, all[0].torque_Nm);
}

TEST(ForwardModel, AnAxisOfOtherElectricalLossesIsShownAsIfSimulated) {
  for (const bool instants : {false, true}) {
    Case data = made_case(0.0);
    for (auto& run : data.fit) run.meter.instants = instants;
    const ForwardModel forward(data.fit, data);
    auto lossy = data.axis, lossless = data.axis;
    lossy.motor.electrical_quadratic_Ws2_per_m2 = {900.0, 700.0};
    lossless.motor.electrical_idle_W = 0.0;
    const auto& run = forward.runs().front();
    const auto all = forward.simulate(run, {lossy, lossless});
    for (const auto& [place, axis] : {std::pair{0U, &lossy}, {1U, &lossless}}) {
      const auto alone = forward.simulate(run, {*axis}).front();
      ASSERT_EQ(all[place].power_W.size(), alone.power_W.size());
      for (std::size_t i = 0; i < alone.power_W.size(); ++i) ASSERT_NEAR(all[place].power_W[i], alone.power_W[i], 1e-8);
    }
    EXPECT_GT(all[0].power_W[500], all[1].power_W[500]);
  }
}

TEST(ForwardModel, LeavesOutOnlySensorsThatAreNotRecorded) {
  const Case bare = made_case(0.0);
  Case whole = bare;
  for (auto& run : whole.fit)
    for (const char* name : {"torque_sensor_Nm", "force_sensor_N"}) run.channels[name] = run.channels.at("position_m");
  const ForwardModel with(whole.fit, whole), without(bare.fit, bare);
  const auto one = with.simulate(with.runs().front(), {whole.axis}).front();
  const auto other = without.simulate(without.runs().front(), {whole.axis}).front();
  ASSERT_GT(bare.fit.front().size(), 1000U);
  EXPECT_EQ(one.force_sensor_N.size(), bare.fit.front().size());
  EXPECT_TRUE(other.force_sensor_N.empty() && other.torque_sensor_Nm.empty());
  EXPECT_EQ(other.torque_Nm, one.torque_Nm);
  EXPECT_EQ(other.power_W, one.power_W);
}

TEST(ForwardModel, PolishingBringsABiasedStartToTheTruthWithinItsInterval) {
  const Case data = made_case(amplitude_Nm);
  const InverseModel model(make_tracks(data.fit, data.axis), data.axis);
  const Fitter fitter(model, data.axis);
  const auto polished = polish(ForwardModel(data.fit, data), fitter, {data.axis, {cogging(1.1 * amplitude_Nm)}});
  const double found = polished.model.effects[0].q[0];
  const auto at = static_cast<Index>(fitter.base().size());
  EXPECT_NEAR(found, amplitude_Nm, 0.005 * amplitude_Nm);
  EXPECT_LT(std::abs(found - amplitude_Nm), 3.0 * std::sqrt(polished.covariance(at, at)));
  EXPECT_LT(std::sqrt(polished.covariance(at, at)), 0.01 * amplitude_Nm);
}

/// A stiff screw's compliance and cogging, polished in closed loop from a biased start.
struct PolishedScrew {
  Index base = 0;
  Polished polished;
  double start_m_per_N = 2e-9;
};

PolishedScrew polished_screw(bool force_sensor) {
  Case data = made_case(amplitude_Nm);
  tests::MadeRun run{.duration_s = 2.0, .sensors = force_sensor, .torque_noise_Nm = 5e-4, .force_noise_N = 0.05};
  run.settings = {.amplitude_m = 0.02, .speed_m_per_s = 0.08};
  data.fit = {tests::make_recording(extended({plant::source_axis(), {cogging(amplitude_Nm)}}).common, run)};
  const InverseModel model(make_tracks(data.fit, data.axis), data.axis);
  const Fitter fitter(model, data.axis);
  PolishedScrew screw{.base = static_cast<Index>(fitter.base().size()), .polished = {}};
  const Active yields{&hypothesis("screw_compliance"), {screw.start_m_per_N, std::log(2e3)}};
  screw.polished = polish(ForwardModel(data.fit, data), fitter, {data.axis, {yields, cogging(1.1 * amplitude_Nm)}});
  return screw;
}

// Rests of a second or two tell the slope of the rise alone: in rise and time constant the fit crept along a ridge.
TEST(ForwardModel, PolishingFindsHowFastBreakawayRisesAndOverWhatPathItGoes) {
  auto truth = plant::source_axis();
  truth.effects.push_back(
      tests::effect("dwell_breakaway", {{"relative_rise", 0.12}, {"time_constant_s", 1.5}, {"memory_distance_m", 5e-5}}));
  Case data = tests::short_case(truth, plant::source_axis());
  data.fit.clear();
  for (const double dwell_s : {0.2, 0.7, 1.5}) {
    tests::MadeRun run{.motion = "s_curve", .duration_s = 8.0, .sensors = false};
    run.settings = {.amplitude_m = 0.005, .speed_m_per_s = 0.05};
    run.settings.dwell_s = dwell_s;
    data.fit.push_back(tests::make_recording(truth, run));
  }
  const InverseModel model(make_tracks(data.fit, data.axis), data.axis);
  const Fitter fitter(model, data.axis);
  const auto& dwell = hypothesis("dwell_breakaway");
  const auto polished = polish(ForwardModel(data.fit, data), fitter, {data.axis, {{&dwell, {0.36 / 4.0, 1.0 / 4.0, 0.0}}}});
  const auto found = dwell.named(polished.model.effects[0].q, data.axis);
  EXPECT_NEAR(found[0].value, 0.12, 0.012);
  EXPECT_NEAR(found[1].value, 1.5, 0.2);
  EXPECT_NEAR(found[2].value, 5e-5, 5e-6) << "it began from 20 um";
}

// The inverse model has no swing: what it makes of a gap is 5 % off, of its flank's stiffness half.
TEST(ForwardModel, PolishingFindsAGapAndItsFlank) {
  auto truth = plant::source_axis();
  truth.effects.push_back(
      tests::effect("backlash", {{"gap_m", 6e-6}, {"stiffness_N_per_m", 6e7}, {"damping_Ns_per_m", 3e3}}));
  Case data = tests::short_case(truth, plant::source_axis());
  tests::MadeRun run{.duration_s = 2.0, .sensors = true, .scale_at_table = true, .force_noise_N = 0.05};
  run.settings = {.amplitude_m = 0.02, .speed_m_per_s = 0.08};
  data.fit = {tests::make_recording(truth, run)};
  const InverseModel model(make_tracks(data.fit, data.axis), data.axis);
  const Fitter fitter(model, data.axis);
  const auto& gap = hypothesis("backlash");
  const auto polished =
      polish(ForwardModel(data.fit, data), fitter, {data.axis, {{&gap, {5.7e-6, 1.0 / 3.2e7, std::log(2e3)}}}});
  const auto found = gap.named(polished.model.effects[0].q, data.axis);
  EXPECT_NEAR(found[0].value, 6e-6, 3e-8);
  EXPECT_NEAR(found[1].value, 6e7, 1e6);
  EXPECT_NEAR(found[2].value, 3e3, 300.0);
}

// The plant's swing has its exact frequency: the force tells the stiffness, wherever the polish starts from.
TEST(ForwardModel, PolishingFindsTheComplianceThatTheRecordedForceShows) {
  constexpr double stiffness_N_per_m = 2.5e8;
  for (const double start : {0.9, 1.1}) {
    auto truth = plant::source_axis();
    truth.effects.push_back(tests::effect("screw_compliance", {{"stiffness_N_per_m", stiffness_N_per_m}}));
    Case data = tests::short_case(truth, plant::source_axis());
    tests::MadeRun run{.duration_s = 2.0, .sensors = true, .torque_noise_Nm = 5e-4, .force_noise_N = 0.05};
    run.settings = {.amplitude_m = 0.02, .speed_m_per_s = 0.08};
    data.fit = {tests::make_recording(truth, run)};
    const InverseModel model(make_tracks(data.fit, data.axis), data.axis);
    const Fitter fitter(model, data.axis);
    const Active yields{&hypothesis("screw_compliance"), {start / stiffness_N_per_m, std::log(2e3)}};
    const auto polished = polish(ForwardModel(data.fit, data), fitter, {data.axis, {yields}});
    EXPECT_NEAR(1.0 / polished.model.effects[0].q[0], stiffness_N_per_m, 0.01 * stiffness_N_per_m) << start;
  }
}

TEST(ForwardModel, WhatTheClosedLoopCannotTellKeepsTheInverseModelsDeviations) {
  const Candidate model{
      plant::source_axis(),
      {{&hypothesis("screw_compliance"), {4e-9, std::log(2e3)}}, {&hypothesis("cogging"), {0.01, 0.01, 8.0}}}};
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Constant(5, 5, 1e-24);
  covariance.diagonal() << 1e-2, 1e-22, 1e-4, 1e-8, 1e-8;
  const Eigen::MatrixXd inverse = 1e-20 * Eigen::MatrixXd::Identity(5, 5);
  EXPECT_EQ(with_what_only_inverse_tells(covariance, inverse, model, 1), covariance);
  covariance.row(1).setZero();
  covariance.col(1).setZero();
  const auto both = with_what_only_inverse_tells(covariance, inverse, model, 1);
  EXPECT_GE(both(1, 1), 1e-20);
  EXPECT_LT(both(1, 1), 1e-19);
  EXPECT_EQ(both.bottomRightCorner(3, 3), covariance.bottomRightCorner(3, 3));
}

TEST(ForwardModel, PolishingMovesTheComplianceWhereNoForceIsRecorded) {
  const auto [base, polished, start_m_per_N] = polished_screw(false);
  EXPECT_NE(polished.model.effects[0].q[0], start_m_per_N);
  EXPECT_GT(polished.covariance(base, base), 0.0);
  EXPECT_NEAR(polished.model.effects[1].q[0], amplitude_Nm, 0.01 * amplitude_Nm);
}

TEST(ForwardModel, ConfirmsWhatIsThereAndNotWhatIsNot) {
  for (const double there_Nm : {amplitude_Nm, 0.0}) {
    const Case data = made_case(there_Nm);
    const InverseModel model(make_tracks(data.fit, data.axis), data.axis);
    const Fitter fitter(model, data.axis);
    const auto whitening = Whitening::estimate(model, model.residual(plant::source_axis(), {}));
    const Fit fit = fitter.fit({data.axis, {cogging(0.001)}}, whitening, 6);
    const auto seen = confirm(ForwardModel(data.holdout, data), fitter, whitening, fit.model, 0);
    if (there_Nm > 0.0)
      EXPECT_GT(seen.error_ratio, 3.0);
    else
      EXPECT_LT(seen.error_ratio, 1.02);
  }
}

TEST(ExtendedAxis, AGapBesideASpringAddsNoSpringOfItsOwn) {
  const auto axis = extended({plant::source_axis(),
                              {{&hypothesis("backlash"), {4e-6, 1.0 / 6e7, std::log(2e3)}},
                               {&hypothesis("screw_compliance"), {2e-8, std::log(2e3)}}}})
                        .common;
  ASSERT_EQ(axis.effects.size(), 2U);
  const auto stiffness = [&axis](std::size_t i) {
    auto setting = axis.effects[i];
    return *plant::value_in(setting, *plant::find_effect(setting.id), "stiffness_N_per_m");
  };
  EXPECT_NEAR(stiffness(1), 5e7, 1.0);
  EXPECT_GE(stiffness(0), 100.0 * stiffness(1));
}

// Friction may rest on a nuisance: then the model without it is another model, which has to be simulated too.
TEST(ExtendedAxis, ThereAreTwoWaysToSimulateAModelWithANuisance) {
  const auto memory = [](double force_N) { return Active{&hypothesis("presliding_memory"), {force_N, 5e-6}}; };
  const auto finding = ways_of({plant::source_axis(), {cogging(amplitude_Nm), memory(80.0)}});
  ASSERT_EQ(finding.size(), 1U);
  EXPECT_EQ(finding[0].common.effects.size(), 2U);
  const auto nuisance = ways_of({plant::source_axis(), {cogging(amplitude_Nm), memory(20.0)}});
  ASSERT_EQ(nuisance.size(), 2U);
  EXPECT_EQ(nuisance[0].common.effects.size(), 1U);
  EXPECT_EQ(nuisance[1].common.effects.size(), 2U);
}

TEST(Pictures, ShowLessLeftOverAfterThanBefore) {
  const Case data = made_case(amplitude_Nm);
  const ForwardModel held_out(data.holdout, data);
  const Track track = make_track(data.holdout.front(), data.axis);
  const auto updated = extended({plant::source_axis(), {cogging(amplitude_Nm)}});
  const auto figures = pictures(held_out, {track}, {data.axis, plant::source_axis(), updated},
                                {tests::named("cogging", "amplitude_Nm", amplitude_Nm)});
  ASSERT_GE(figures.size(), 5U);  // over the angle, position, speed, time since reversal, time
  EXPECT_EQ(figures[0].x.unit, "deg");
  const auto rms = [](const tools::FigureSeries& series) {
    double sum = 0.0;
    for (const double y : series.y) sum += y * y;
    return std::sqrt(sum / static_cast<double>(series.y.size()));
  };
  for (const auto& figure : figures) {
    ASSERT_GE(figure.series.size(), 2U) << figure.title;
    const auto& after = figure.series[figure.series.size() / 2];
    EXPECT_LT(rms(after), 0.3 * rms(figure.series[0])) << figure.title;
  }
}

}  // namespace
}  // namespace feedtwin

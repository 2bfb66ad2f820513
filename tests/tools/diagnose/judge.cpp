// What a hypothesis is worth: in which equation, and from how far a fit arrives.

#include "tools/diagnose/judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/made_case.h"
#include "tools/diagnose/hypotheses/shapes.h"
#include "tools/diagnose/screen.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

struct Judged : testing::Test {
  plant::AxisParameters axis = plant::source_axis();
  InverseModel model{
      make_tracks({tests::make_recording(axis, {.motion = "sine", .duration_s = 4.0, .force_noise_N = 0.05})}, axis), axis};
  Fitter fitter{model, axis};
};

TEST_F(Judged, AnEffectIsStrongInTheEquationsThatItMovesAndInNoOther) {
  Fit with, without;
  with.residual = Vector::Constant(model.rows(), 1.0);
  for (std::size_t e = 0; e < model.equations().size(); ++e) {
    without.residual = with.residual;
    for (const auto& s : model.segments())
      if (s.equation == e) without.residual.segment(s.start, s.size).array() += 2.0;
    const auto found = strengths(model, with, without, true, Bar{});
    for (std::size_t other = 0; other < found.size(); ++other) EXPECT_NEAR(found[other], other == e ? 2.0 : 0.0, 1e-12);
    EXPECT_EQ(strength(model, with, without, true, Bar{}), found[e]);
  }
  EXPECT_GT(model.equations().size(), 1U);
}

// A stop at the end of the travel says nothing about a bump in its middle.
TEST_F(Judged, AnEffectIsComparedWithOthersWhereItActs) {
  const auto& rows = model.segments().front();
  Fit with, without_bump, without_stop;
  with.residual = without_bump.residual = without_stop.residual = Vector::Constant(model.rows(), 1.0);
  without_bump.residual.segment(rows.start + rows.size / 2, 40).array() += 3.0;
  without_stop.residual.segment(rows.start + rows.size - 40, 40).array() += 300.0;
  const auto there = rows_of(model, with, without_bump);
  EXPECT_EQ(std::ranges::count(there, true), 40);
  EXPECT_GT(strengths(model, with, without_stop, true, Bar{})[rows.equation], 10.0);
  EXPECT_EQ(strengths(model, with, without_stop, true, Bar{}, there)[rows.equation], 0.0);
  EXPECT_EQ(strengths(model, with, without_bump, true, Bar{}, there)[rows.equation], 3.0);
}

// A gain that all numbers behind it could do leaves nothing over; that they would all be far off by the same tells it.
TEST_F(Judged, NumbersThatWouldBeFarOffNameWhatLeavesNothingOver) {
  Fit with, without;
  with.residual = without.residual = Vector::Constant(model.rows(), 1.0);
  with.base = without.base = fitter.base();
  const auto numbers = static_cast<Index>(fitter.base().size());
  for (const double squares : {30.0, 50.0}) {
    with.white = without.white = Vector::Zero(model.rows() + numbers);
    without.white.tail(numbers).setConstant(std::sqrt(squares / static_cast<double>(numbers)));
    with.cost = 0.0, without.cost = squares;
    const auto of_sensor = judged(fitter, with, without, hypothesis("sensor_gain"), Bar{});
    EXPECT_EQ(of_sensor.enough, squares > 40.0);
    EXPECT_EQ(of_sensor.far_off, squares > 40.0);
    EXPECT_FALSE(judged(fitter, with, without, hypothesis("torque_offset"), Bar{}).enough);
  }
}

TEST_F(Judged, AHypothesisMayAskForMoreThanTheOthers) {
  Fit with, without;
  with.residual = Vector::Constant(model.rows(), 1.0);
  without.residual = Vector::Constant(model.rows(), 3.0);
  with.white = without.white = Vector::Zero(model.rows());
  Hypothesis modest = hypothesis("cogging");
  modest.shapes.clear();
  Hypothesis asking = modest;
  asking.least_gain = 100.0;
  for (const double gain : {99.0, 101.0}) {
    without.cost = with.cost + gain;
    EXPECT_TRUE(judged(fitter, with, without, modest, Bar{}).enough);
    EXPECT_EQ(judged(fitter, with, without, asking, Bar{}).enough, gain > 100.0);
  }
}

// One that closed loop cannot miss enough leads astray what is asked beside it: the few mm/s about a reversal suit it
// whatever friction does there.
TEST_F(Judged, ACompensationAboutAReversalMustGainWhatItIsToBeMissedBy) {
  Fit with, without;
  with.residual = Vector::Constant(model.rows(), 1.0);
  without.residual = Vector::Constant(model.rows(), 3.0);
  with.white = without.white = Vector::Zero(model.rows());
  const auto& compensation = hypothesis("hidden_friction_compensation");
  const auto told = [&](double speed_m_per_s, double gain) {
    with.model.effects = {{&compensation, {0.004, speed_m_per_s, 0.0, 1.0}}};
    without.cost = with.cost + gain;
    return judged(fitter, with, without, compensation, Bar{}).enough;
  };
  EXPECT_FALSE(told(1.8e-3, 1669.0));
  EXPECT_TRUE(told(1.8e-3, 1956.0));
  EXPECT_TRUE(told(4.5e-3, 300.0));
}

TEST_F(Judged, AFitGoesOnWhileItFallsFast) {
  const Whitening whitening = Whitening::estimate(model, model.residual(axis, {}));
  Candidate start{axis, {}};
  start.axis.motor.inertia_kgm2 *= 8.0;  // a step is two fifths of the value at most: two of them do not arrive
  const Fit fit = fitter.fit(start, whitening, 2);
  EXPECT_NEAR(fit.model.axis.motor.inertia_kgm2, axis.motor.inertia_kgm2, 0.01 * axis.motor.inertia_kgm2);
}

TEST_F(Judged, ANumberThatAWrongModelTookToNothingFindsItsWayBack) {
  const Whitening whitening = Whitening::estimate(model, model.residual(axis, {}));
  Candidate start{axis, {}};
  start.axis.ball_screw.coulomb_N.pos = 1e-3;
  const Fit fit = fitter.fit(start, whitening, 1);
  EXPECT_NEAR(fit.model.axis.ball_screw.coulomb_N.pos, axis.ball_screw.coulomb_N.pos, 0.05 * axis.ball_screw.coulomb_N.pos);
}

/// Runs of an axis with two effects. Beside the first, fitted from this start, the second is fitted too: its numbers.
std::vector<double> fitted_beside(const Active& start, const std::vector<plant::EffectSetting>& effects) {
  auto truth = plant::source_axis(), nominal = truth;
  truth.effects = effects;
  nominal.motor.inertia_kgm2 *= 1.05;
  nominal.ball_screw.coulomb_N.pos *= 0.95;
  std::vector<tools::Recording> runs;
  for (const double speed : {0.02, 0.09})
    runs.push_back(tests::make_recording(truth, {.motion = "sine",
                                                 .settings = {.amplitude_m = 0.02, .speed_m_per_s = speed},
                                                 .duration_s = 6.0,
                                                 .scale_at_table = true,
                                                 .seed = static_cast<unsigned>(1000.0 * speed)}));
  const InverseModel model(make_tracks(runs, nominal), nominal);
  const Fitter fitter(model, nominal);
  auto whitening = Whitening::estimate(model, model.residual(nominal, {}));
  const Fit first = fitter.fit_with_colour({nominal, {start}}, whitening, 2, 6);
  const auto scores = scores_of({&hypothesis(effects[1].id)}, fitter, first, whitening);
  return fit_with(fitter, first.model, scores.front(), 1, whitening, 6).model.effects[1].q;
}

// Whatever moves the mark's angle, a pass falls into another sample: a step that does so costs more than all else can bring.
TEST(Jumps, AnEffectIsFittedBesideAMarkThatLosesCounts) {
  constexpr double amplitude_N = 4.0;
  const auto q = fitted_beside(
      {&hypothesis("count_loss"), {139.0, 3.06}},
      {tests::effect("count_loss", {{"counts_per_pass", 141.0}, {"angle_rad", 3.1}}),
       tests::effect("rev_ripple", {{"amplitude_N", amplitude_N}, {"cycles_per_rev", 3.37}, {"phase_rad", 1.5}})});
  EXPECT_NEAR(std::hypot(q[0], q[1]), amplitude_N, 0.1 * amplitude_N);
}

TEST(Jumps, AnEffectIsFittedBesideAStopThatIsMetASampleEarlierOrLater) {
  constexpr double amplitude_m = 8e-6;
  const auto q = fitted_beside(
      {&hypothesis("hard_stop"), {8e5, 6e3, 0.01935, 1.0}},
      {tests::effect("hard_stop",
                     {{"position_m", 0.0194}, {"direction", 1.0}, {"stiffness_N_per_m", 2e5}, {"damping_Ns_per_m", 1e4}}),
       tests::effect("encoder_eccentricity", {{"amplitude_m", amplitude_m}, {"cycles_per_rev", 1.0}, {"phase_rad", -1.3}})});
  EXPECT_NEAR(std::hypot(q[0], q[1]), amplitude_m, 0.1 * amplitude_m);
}

TEST(Starts, ASoftStopIsFoundDeepInsideTheTravel) {
  constexpr double position_m = 0.07, stiffness_N_per_m = 2500.0;
  auto nominal = plant::source_axis();
  nominal.axis.stroke_m = 0.4;
  auto truth = nominal;
  truth.effects.push_back(tests::effect(
      "hard_stop", {{"position_m", position_m}, {"stiffness_N_per_m", stiffness_N_per_m}, {"damping_Ns_per_m", 20.0}}));
  tests::MadeRun run{.motion = "triangle", .duration_s = 6.0, .force_noise_N = 0.01};
  run.settings.amplitude_m = 0.1;
  run.settings.speed_m_per_s = 0.15;
  const std::vector<tools::Recording> runs{tests::make_recording(truth, run)};
  const InverseModel model(make_tracks(runs, nominal), nominal);
  const Fitter fitter(model, nominal);
  const Whitening whitening = fitter.colour_of(model.residual(nominal, {}));
  const Fit base = fitter.fit({nominal, {}}, whitening, 6);
  const auto scores = scores_of({&hypothesis("hard_stop")}, fitter, base, whitening);
  ASSERT_EQ(scores.size(), 1U);
  const auto q = fit_with(fitter, base.model, scores.front(), 0, whitening, 6).model.effects[0].q;
  EXPECT_NEAR(q[0], stiffness_N_per_m, 0.05 * stiffness_N_per_m);
  EXPECT_NEAR(q[2], position_m, 1e-3);
}

TEST(Starts, ADeadTimeOfSeveralTicksIsReachedThoughASensorReadsAnotherCommandWithEach) {
  constexpr double delay_s = 3.4e-3;
  auto truth = plant::source_axis(), nominal = truth;
  truth.effects.push_back(tests::effect("input_delay", {{"delay_s", delay_s}}));
  nominal.motor.inertia_kgm2 *= 1.05;
  std::vector<tools::Recording> runs;
  for (const char* motion : {"triangle", "sine"})
    runs.push_back(
        tests::make_recording(truth, {.motion = motion, .duration_s = 4.0, .torque_noise_Nm = 5e-5, .force_noise_N = 0.01}));
  const InverseModel model(make_tracks(runs, nominal), nominal);
  const Fitter fitter(model, nominal);
  const Whitening whitening = fitter.colour_of(model.residual(nominal, {}));
  const Score delay{.hypothesis = &hypothesis("input_delay"), .q = {1e-4}};
  const Fit fit = fit_with(fitter, {nominal, {}}, delay, 0, whitening, 6);
  EXPECT_NEAR(fit.model.effects[0].q[0], delay_s, 0.02 * delay_s);
}

TEST(Lines, ARunThatIsNotThereHasNoPartInTheAmplitude) {
  const std::vector<double> q{3.0, 4.0, -5.0, 0.0, 0.0, 0.0, 0.03, 0.0, 50.0};  // the last run: a step of differences
  EXPECT_TRUE(has_line(q, 0) && has_line(q, 1));
  EXPECT_FALSE(has_line(q, 2) || has_line(q, 3));
  EXPECT_DOUBLE_EQ(line_amplitude(q), 5.0);
}

// Below it the plant takes static friction for Coulomb's: nothing but the prior has a slope there, and its step ends far
// off.
TEST(Fitter, ANumberThatTheRunsSayNothingOfDoesNotKeepTheOthersFromMoving) {
  plant::AxisParameters truth = plant::source_axis(), start = truth;
  for (auto* contact : {&truth.ball_screw, &truth.guide}) contact->static_N = contact->coulomb_N;
  for (auto* contact : {&start.ball_screw, &start.guide})
    contact->static_N = {0.7 * contact->coulomb_N.pos, 0.7 * contact->coulomb_N.neg};
  start.guide_mass_kg *= 1.1;
  const InverseModel model(
      make_tracks({tests::make_recording(truth, {.motion = "sine", .duration_s = 4.0, .force_noise_N = 0.05})}, truth),
      truth);
  const Fitter fitter(model, plant::source_axis());
  const Whitening whitening = fitter.colour_of(model.residual(truth, {}));
  const Fit fit = fitter.fit({start, {}}, whitening, 6);
  EXPECT_NEAR(fit.model.axis.guide_mass_kg, truth.guide_mass_kg, 0.02 * truth.guide_mass_kg);
}

// Power that is given back and clipped bends the numbers where it is not named, and with them the forces, which show a
// delay. A spring acts on the forces itself.
TEST_F(Judged, AnEffectIsHiddenByWhatAnotherDoesItselfAlone) {
  const auto share_beside_the = [&](const char* other, std::vector<double> size) {
    Fit fit;
    fit.model = {axis, {{&hypothesis("input_delay"), {3e-4}}, {&hypothesis(other), std::move(size)}}};
    fit.residual = model.residual(axis, fit.model.effects);
    std::vector<Fit> less(2, fit);
    const Vector of_a_spring =
        model.residual(axis, {{&hypothesis("cable_spring"), {200.0, 0.0}}}) - model.residual(axis, {});
    for (const auto& s : model.segments()) {
      if (model.equations()[s.equation].power || of_a_spring.segment(s.start, s.size).isZero()) continue;
      less[0].residual.segment(s.start, s.size).array() += 0.6;
      less[1].residual.segment(s.start, s.size).array() += 170.0;
    }
    return share_beside(model, fit, less, 0, Bar{});
  };
  EXPECT_GT(share_beside_the("regeneration_clipped", {1.0}), 0.1);
  EXPECT_LT(share_beside_the("cable_spring", {1e6, 0.0}), 0.02);
}

// A lead's wave beside lost counts that are 250 times what is left over: it leaves a seventh, and so in every fold.
TEST(HiddenBeside, WhatLeavesNextToNothingIsNotWhatAnotherModelLeaves) {
  const auto hidden = [](double strength, bool everywhere) {
    Verdict verdict;
    verdict.strength = strength;
    Unseen unseen;
    unseen.everywhere = everywhere;
    return hidden_beside(strength / 250.0, verdict, unseen, Bar{});
  };
  EXPECT_FALSE(hidden(7.0, true));
  EXPECT_TRUE(hidden(7.0, false));
  EXPECT_TRUE(hidden(1.7, true));
  EXPECT_FALSE(hidden(20.0, false));
}

}  // namespace
}  // namespace feedtwin

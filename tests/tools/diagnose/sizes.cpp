// Which names go because they have no size once the closed loop has polished the numbers.

#include "tools/diagnose/forward/sizes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/diagnose/cogged.h"
#include "tools/diagnose/forward/extended_axis.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;
using tests::Cogged, tests::silent;

TEST(Sizes, WhatOtherNumbersCanTakeUpIsTakenBackWhereItsOwnAreNotTold) {
  const Cogged made;
  Candidate model{made.data.axis,
                  {{&hypothesis("cogging"), {0.01, 0.0, 8.0}}, {&hypothesis("direction_dependent_friction"), {0.4, 0.0}}}};
  for (auto* friction_N : {&model.axis.ball_screw.coulomb_N, &model.axis.ball_screw.static_N})
    friction_N->pos -= 0.2, friction_N->neg += 0.2;
  for (const bool told : {true, false}) {
    Fit fit = made.fitter.linearised(model, made.whitening);
    SearchResult result;
    for (const auto& effect : model.effects) result.found.emplace_back().effect = effect;
    Eigen::MatrixXd covariance = fit.covariance;
    covariance.bottomRows(2).setZero();
    covariance.rightCols(2).setZero();
    covariance.bottomRightCorner<2, 2>().diagonal().setConstant(std::pow(told ? 0.01 : 0.4, 2));
    drop_sizeless(made.forward, made.fitter, model, result, fit, covariance, silent);
    EXPECT_EQ(fit.model.effects.size(), told ? 2U : 1U);
    EXPECT_EQ(result.found.size(), fit.model.effects.size());
    EXPECT_EQ(fit.model.effects[0].hypothesis->id, "cogging");
  }
}

TEST(Sizes, WhatTheClosedLoopFindsToBeNothingIsTakenBackAndNothingElse) {
  const Cogged made;
  const Candidate both{made.data.axis,
                       {{&hypothesis("cogging"), {0.01, 0.0, 8.0}}, {&hypothesis("torque_ripple"), {1e-7, 0.0, 8.0}}}};
  Fit fit = made.fitter.linearised(both, made.whitening);
  SearchResult result;
  for (const auto& effect : both.effects) {
    Found named;
    named.effect = effect;
    result.found.push_back(named);
  }
  Eigen::MatrixXd covariance = fit.covariance;
  drop_sizeless(made.forward, made.fitter, both, result, fit, covariance, silent);
  ASSERT_EQ(fit.model.effects.size(), 1U);
  EXPECT_EQ(fit.model.effects[0].hypothesis->id, "cogging");
  ASSERT_EQ(result.found.size(), 1U);
  EXPECT_EQ(result.found[0].effect.hypothesis->id, "cogging");
  EXPECT_EQ(covariance.rows(), fit.base_count() + static_cast<Index>(freedom(hypothesis("cogging"))));
}

TEST(Sizes, WhatOneEngineFindsTenTimesAsLargeAsTheOtherIsTakenBack) {
  const Cogged made;
  const auto left_of = [&made](double by_inverse_model_Nm, double missed_nats) {
    const auto with = [&made](double amplitude_Nm) {
      return Candidate{made.data.axis, {{&hypothesis("cogging"), {amplitude_Nm, 0.0, 8.0}}}};
    };
    Fit fit = made.fitter.linearised(with(0.01), made.whitening);
    SearchResult result;
    result.found.emplace_back().effect = fit.model.effects[0];
    result.found[0].missed_nats = missed_nats;
    Eigen::MatrixXd covariance = fit.covariance;
    drop_sizeless(made.forward, made.fitter, with(by_inverse_model_Nm), result, fit, covariance, silent);
    EXPECT_EQ(result.found.size(), fit.model.effects.size());
    return fit.model.effects.size();
  };
  EXPECT_EQ(left_of(0.02, 0.0), 1U);
  EXPECT_EQ(left_of(0.1, 0.0), 0U);
  EXPECT_EQ(left_of(0.1, 1000.0), 1U) << "the closed loop misses it";
  EXPECT_EQ(left_of(0.03, 5.0), 1U);
  EXPECT_EQ(left_of(0.03, -5.0), 0U) << "the closed loop does better without";
}

TEST(Sizes, AboutReversalsTheInverseModelsSizeIsNoMeasureOfWhatIsMissed) {
  const Cogged made;
  const auto stays = [&made](const char* id, std::vector<double> q, std::vector<double> by_inverse_model,
                             double missed_nats) {
    const Candidate model{made.data.axis, {{&hypothesis(id), std::move(q)}}};
    Fit fit = made.fitter.linearised(model, made.whitening);
    SearchResult result;
    result.found.emplace_back().effect = model.effects[0];
    result.found[0].missed_nats = missed_nats;
    Eigen::MatrixXd covariance = 1e-12 * Eigen::MatrixXd::Identity(fit.covariance.rows(), fit.covariance.cols());
    const Candidate inverse{made.data.axis, {{&hypothesis(id), std::move(by_inverse_model)}}};
    drop_sizeless(made.forward, made.fitter, inverse, result, fit, covariance, silent);
    return !fit.model.effects.empty();
  };
  const std::vector<double> memory{20.0, 2e-5}, six_times{120.0, 2e-5};
  EXPECT_TRUE(stays("presliding_memory", memory, memory, 0.0));
  EXPECT_TRUE(stays("presliding_memory", memory, six_times, 150.0));
  EXPECT_FALSE(stays("presliding_memory", memory, six_times, 50.0));
  EXPECT_FALSE(stays("cogging", {0.01, 0.0, 8.0}, {0.06, 0.0, 8.0}, 150.0)) << "which acts everywhere";
}

// What every unseen stretch bears out may be little beside a noisy channel.
TEST(Sizes, WhatStandsOnEveryUnseenFoldMayBeLittleBesideNoise) {
  const Cogged made;
  const auto stays = [&made](bool held_everywhere, double strength, double missed_nats) {
    constexpr double little_Nm = 0.00025;  // beside cogging of 0.01: 2.5 % of what is left
    const Candidate model{made.data.axis, {{&hypothesis("cogging"), {little_Nm, 0.0, 8.0}}}};
    Fit fit = made.fitter.linearised(model, made.whitening);
    SearchResult result;
    Found& named = result.found.emplace_back();
    named.effect = model.effects.front();
    named.held_everywhere = held_everywhere, named.strength = strength, named.missed_nats = missed_nats;
    Eigen::MatrixXd covariance = 1e-12 * Eigen::MatrixXd::Identity(fit.covariance.rows(), fit.covariance.cols());
    drop_sizeless(made.forward, made.fitter, model, result, fit, covariance, silent);
    return !fit.model.effects.empty();
  };
  EXPECT_TRUE(stays(true, 0.5, 200.0));
  EXPECT_FALSE(stays(false, 0.5, 200.0));
  EXPECT_FALSE(stays(true, 0.2, 200.0));
  EXPECT_FALSE(stays(true, 0.5, 50.0));
}

// A slope of sliding friction in parts of it, and of the viscous in N s/m: what the one engine has of the second is no
// measure of the first.
TEST(Sizes, AmplitudesOfOtherUnitsAreWeighedByTheirSteps) {
  const Cogged made;
  const auto& slope = hypothesis("position_friction");
  const Candidate model{made.data.axis, {{&slope, {0.2, 0.0, 0.0}}}};
  for (const double sliding_by_inverse_model : {0.2, 2.0}) {
    const Candidate by_inverse_model{made.data.axis, {{&slope, {sliding_by_inverse_model, 30.0, -30.0}}}};
    Fit fit = made.fitter.linearised(model, made.whitening);
    SearchResult result;
    result.found.emplace_back().effect = model.effects[0];
    Eigen::MatrixXd covariance = 1e-6 * fit.covariance;
    drop_sizeless(made.forward, made.fitter, by_inverse_model, result, fit, covariance, silent);
    EXPECT_EQ(fit.model.effects.size(), sliding_by_inverse_model < 1.0 ? 1U : 0U) << sliding_by_inverse_model;
  }
}

// How far it would go and how long it would take make up for each other; how fast it goes is known, if it is.
TEST(Sizes, OfADriftThatNoRunSeesTheEndOfTheRateIsWhatIsKnown) {
  const Cogged made;
  const auto& drift = hypothesis("friction_drift");
  const std::vector<double> q{0.26, 49.0, 0.0, 0.0, 0.0, 0.0};
  const Candidate model{made.data.axis, {{&drift, q}}};
  const double own = 0.13, of_the_rate = 0.01, time_constant_s = 20.0;
  for (const bool makes_up : {true, false}) {
    Fit fit = made.fitter.linearised(model, made.whitening);
    SearchResult result;
    result.found.emplace_back().effect = model.effects[0];
    const auto unknowns = static_cast<Index>(freedom(drift)), from = fit.base_count();
    Eigen::MatrixXd covariance = fit.covariance;
    covariance.bottomRows(unknowns).setZero();
    covariance.rightCols(unknowns).setZero();
    covariance.bottomRightCorner(unknowns, unknowns).diagonal().setConstant(1e-6);
    covariance(from, from) = own * own;
    covariance(from + 1, from + 1) = time_constant_s * time_constant_s;
    const double together = makes_up ? std::sqrt(own * own - of_the_rate * of_the_rate) * time_constant_s : 0.0;
    covariance(from, from + 1) = covariance(from + 1, from) = together;
    drop_sizeless(made.forward, made.fitter, model, result, fit, covariance, silent);
    EXPECT_EQ(fit.model.effects.size(), makes_up ? 1U : 0U);
  }
}

// Its own deviations are large because it goes with the effect's other numbers.
TEST(Sizes, WhatIsMissedIsToldHoweverWideItsAmplitudeIs) {
  constexpr double amplitude_Nm = 3.8e-4;
  const Cogged made;
  const Candidate model{made.data.axis, {{&hypothesis("cogging"), {amplitude_Nm, 0.0, 8.0}}}};
  const auto& torque = "torque_cmd_Nm";
  const double change = made.forward.nrmse(made.data.axis).at(torque) / made.forward.nrmse(extended(model)).at(torque) - 1.0;
  ASSERT_GT(change, 0.03);
  ASSERT_LT(change, 0.05) << "without doubt";
  for (const double missed_nats : {50.0, 137.0}) {
    Fit fit = made.fitter.linearised(model, made.whitening);
    SearchResult result;
    result.found.emplace_back().effect = model.effects[0];
    result.found[0].missed_nats = missed_nats;
    Eigen::MatrixXd covariance = fit.covariance;
    covariance.bottomRows(3).setZero();
    covariance.rightCols(3).setZero();
    covariance.bottomRightCorner<3, 3>().diagonal().setConstant(std::pow(amplitude_Nm / 1.7, 2));
    drop_sizeless(made.forward, made.fitter, model, result, fit, covariance, silent);
    EXPECT_EQ(fit.model.effects.size(), missed_nats > 100.0 ? 1U : 0U) << missed_nats;
  }
}

TEST(Sizes, WhatComesOutAtASizeThatCannotBeIsTakenBackHoweverMuchItIsMissed) {
  const Cogged made;
  for (const double rise : {0.1, 0.02}) {
    const Candidate model{made.data.axis, {{&hypothesis("dwell_breakaway"), {rise, 1.0, 0.0}}}};
    Fit fit = made.fitter.linearised(model, made.whitening);
    SearchResult result;
    result.found.emplace_back().effect = model.effects[0];
    result.found[0].missed_nats = 1000.0;
    Eigen::MatrixXd covariance = 1e-6 * fit.covariance;
    drop_sizeless(made.forward, made.fitter, model, result, fit, covariance, silent);
    EXPECT_EQ(fit.model.effects.size(), rise > 0.03 ? 1U : 0U) << rise;
  }
}

// Friction by direction is what two numbers could do.
TEST(Sizes, WhatIsNotFarFromNothingIsTakenBackHoweverMuchItIsMissed) {
  const Cogged made;
  const Candidate model{made.data.axis, {{&hypothesis("direction_dependent_friction"), {20.0, 0.0}}}};
  for (const double deviation_N : {1.5, 4.0}) {
    Fit fit = made.fitter.linearised(model, made.whitening);
    SearchResult result;
    result.whitening = made.whitening;
    result.found.emplace_back().effect = model.effects[0];
    result.found[0].missed_nats = 1000.0;
    Eigen::MatrixXd covariance = fit.covariance;
    covariance.bottomRows(2).setZero();
    covariance.rightCols(2).setZero();
    covariance.bottomRightCorner<2, 2>().diagonal().setConstant(std::pow(deviation_N, 2));
    drop_sizeless(made.forward, made.fitter, model, result, fit, covariance, silent);
    EXPECT_EQ(fit.model.effects.size(), deviation_N < 2.0 ? 1U : 0U) << deviation_N;  // 13 from nothing; 5
  }
}

TEST(Sizes, WhatIsMissedByFarAndMultipliesAChannelsErrorStaysHoweverWideItIs) {
  constexpr double weight_N = 20.0;
  auto truth = plant::source_axis();
  truth.effects.push_back(tests::effect("gravity", {{"force_N", weight_N}}));
  tools::Case data;
  data.axis = plant::source_axis();
  for (const char* motion : {"sine", "triangle"})
    data.fit.push_back(tests::make_recording(truth, {.motion = motion, .duration_s = 8.0, .sensors = false}));
  const InverseModel model(make_tracks(data.fit, data.axis), data.axis);
  const Fitter fitter(model, data.axis);
  const ForwardModel forward(data.fit, data);
  const Candidate weighed{data.axis, {{&hypothesis("gravity"), {weight_N}}}};
  const Whitening whitening = fitter.colour_of(model.residual(data.axis, weighed.effects));
  for (const double missed_nats : {6000.0, 4000.0}) {
    Fit fit = fitter.linearised(weighed, whitening);
    SearchResult result;
    result.whitening = whitening;
    result.found.emplace_back().effect = weighed.effects.front();
    result.found.front().missed_nats = missed_nats;
    Eigen::MatrixXd covariance = fit.covariance;
    covariance.bottomRows(1).setZero();
    covariance.rightCols(1).setZero();
    covariance.bottomRightCorner<1, 1>().setConstant(std::pow(weight_N / 6.0, 2));
    drop_sizeless(forward, fitter, {data.axis, {}}, result, fit, covariance, silent);
    EXPECT_EQ(fit.model.effects.size(), missed_nats > 5000.0 ? 1U : 0U) << missed_nats;
  }
}

/// Runs with a cable's spring, and both engines on them.
struct OnACable {
  static constexpr double stiffness_N_per_m = 600.0;
  tools::Case data = made();
  InverseModel model{make_tracks(data.fit, data.axis), data.axis};
  Fitter fitter{model, data.axis};
  ForwardModel forward{data.fit, data};
  Whitening whitening = fitter.colour_of(model.residual(data.axis, {}));
  Candidate with_spring{data.axis, {{&hypothesis("cable_spring"), {stiffness_N_per_m, 0.0}}}};

  static tools::Case made() {
    auto truth = plant::source_axis();
    truth.effects.push_back(tests::effect("cable_spring", {{"stiffness_N_per_m", stiffness_N_per_m}, {"neutral_m", 0.0}}));
    tools::Case data;
    data.axis = plant::source_axis();
    for (const char* motion : {"sine", "triangle"})
      data.fit.push_back(tests::make_recording(truth, {.motion = motion, .duration_s = 8.0, .sensors = false}));
    return data;
  }
};

// Its own deviations are wide; what it does is not.
TEST(Sizes, AnEffectWithoutWhichStructureComesBackStaysIfItIsMissedAtAll) {
  const OnACable made;
  for (const double missed_nats : {20.0, 1.0}) {
    Fit fit = made.fitter.linearised(made.with_spring, made.whitening);
    SearchResult result;
    result.whitening = made.whitening;
    result.found.emplace_back().effect = made.with_spring.effects.front();
    result.found.front().missed_nats = missed_nats;
    Eigen::MatrixXd covariance = fit.covariance;
    covariance.bottomRows(2).setZero();
    covariance.rightCols(2).setZero();
    covariance.bottomRightCorner<2, 2>().diagonal().setConstant(std::pow(3.0 * OnACable::stiffness_N_per_m, 2));
    drop_sizeless(made.forward, made.fitter, made.with_spring, result, fit, covariance, silent);
    EXPECT_EQ(fit.model.effects.size(), missed_nats > 3.0 ? 1U : 0U);
  }
}

}  // namespace
}  // namespace feedtwin

// The second engine's judgement between confused explanations, and what its likelihoods rest on.

#include "tools/diagnose/forward/arbiter.h"

#include <gtest/gtest.h>

#include "tests/support/made_case.h"
#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/forward/sizes.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;
const std::function<void(std::string_view)> silent = [](std::string_view) {};

/// Runs of the source's axis with cogging that the nominal axis does not have.
struct Cogged {
  tools::Case data;
  InverseModel model;
  Fitter fitter;
  ForwardModel forward;
  Candidate nominal;
  Whitening whitening;

  Cogged()
      : data(made()),
        model(make_tracks(data.fit, data.axis), data.axis),
        fitter(model, data.axis),
        forward(data.fit, data),
        nominal{data.axis, {}},
        whitening(fitter.colour_of(model.residual(data.axis, {}))) {}

  static tools::Case made() {
    auto truth = plant::source_axis();
    truth.effects.push_back(tests::effect("cogging", {{"amplitude_Nm", 0.01}, {"cycles_per_rev", 8.0}}));
    return tests::short_case(truth, plant::source_axis());
  }
  /// What the arbiter leaves of this explanation.
  [[nodiscard]] std::string_view settled(const Active& explanation) const {
    Fit fit = fitter.fit({data.axis, {explanation}}, whitening, 6);
    SearchResult result;
    result.whitening = whitening;
    Found named;
    named.effect = fit.model.effects[0];
    result.found.push_back(named);
    (void)Arbiter(forward, fitter, silent).settle(result, fit);
    EXPECT_EQ(result.found[0].effect.hypothesis, fit.model.effects[0].hypothesis);
    return fit.model.effects[0].hypothesis->id;
  }
};

TEST(Likelihood, PrefersTheAxisThatMadeTheRunsAndNothingToItself) {
  const Cogged made;
  const auto without = likelihood(made.forward, made.data.axis),
             with = likelihood(made.forward, extended({made.data.axis, {{&hypothesis("cogging"), {0.01, 0.0, 8.0}}}}));
  EXPECT_EQ(compared(with, with).nats, 0.0);
  EXPECT_GT(compared(with, without).nats, 100.0);
  EXPECT_GT(compared(with, without).deviations, 3.0);
  EXPECT_NEAR(compared(without, with).nats, -compared(with, without).nats, 1e-6);
}

TEST(Arbiter, PutsTheRightEffectInTheWrongOnesPlaceAndLeavesTheRightOne) {
  const Cogged made;
  EXPECT_EQ(made.settled({&hypothesis("torque_ripple"), {0.0, 0.0, 8.0}}), "cogging");
  EXPECT_EQ(made.settled({&hypothesis("cogging"), {0.0, 0.0, 8.0}}), "cogging");
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
  drop_sizeless(made.forward, both, result, fit, covariance, silent);
  ASSERT_EQ(fit.model.effects.size(), 1U);
  EXPECT_EQ(fit.model.effects[0].hypothesis->id, "cogging");
  ASSERT_EQ(result.found.size(), 1U);
  EXPECT_EQ(result.found[0].effect.hypothesis->id, "cogging");
  EXPECT_EQ(covariance.rows(), fit.base_count() + static_cast<Index>(freedom(hypothesis("cogging"))));
}

TEST(Sizes, WhatOneEngineFindsTenTimesAsLargeAsTheOtherIsTakenBack) {
  const Cogged made;
  const auto left_of = [&made](double by_inverse_model_Nm) {
    const auto with = [&made](double amplitude_Nm) {
      return Candidate{made.data.axis, {{&hypothesis("cogging"), {amplitude_Nm, 0.0, 8.0}}}};
    };
    Fit fit = made.fitter.linearised(with(0.01), made.whitening);
    SearchResult result;
    result.found.emplace_back().effect = fit.model.effects[0];
    Eigen::MatrixXd covariance = fit.covariance;
    drop_sizeless(made.forward, with(by_inverse_model_Nm), result, fit, covariance, silent);
    EXPECT_EQ(result.found.size(), fit.model.effects.size());
    return fit.model.effects.size();
  };
  EXPECT_EQ(left_of(0.02), 1U);
  EXPECT_EQ(left_of(0.1), 0U);
}

}  // namespace
}  // namespace feedtwin

// The second engine's judgement between confused explanations, and what its likelihoods rest on.

#include "tools/diagnose/forward/arbiter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/diagnose/cogged.h"
#include "tools/diagnose/forward/closest.h"
#include "tools/diagnose/forward/confirm.h"
#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/forward/missed.h"
#include "tools/diagnose/forward/ruling.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;
using tests::Cogged, tests::silent;

/// What the arbiter leaves of this explanation.
std::string_view settled(const Cogged& made, const Active& explanation) {
  Fit fit = made.fitter.fit({made.data.axis, {explanation}}, made.whitening, 6);
  SearchResult result;
  result.whitening = made.whitening;
  Found named;
  named.effect = fit.model.effects[0];
  result.found.push_back(named);
  (void)Arbiter(made.forward, made.fitter, silent).settle(result, fit);
  EXPECT_EQ(result.found[0].effect.hypothesis, fit.model.effects[0].hypothesis);
  return fit.model.effects[0].hypothesis->id;
}

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
  EXPECT_EQ(settled(made, {&hypothesis("torque_ripple"), {0.0, 0.0, 8.0}}), "cogging");
  EXPECT_EQ(settled(made, {&hypothesis("cogging"), {0.0, 0.0, 8.0}}), "cogging");
}

// Growth that is over at once is a lead that is wrong.
TEST(Arbiter, OfACaseOfTheOtherTheSimplerIsToldWhereItIsAsLikely) {
  const auto &growth = hypothesis("screw_growth"), &lead = hypothesis("lead_error"), &gap = hypothesis("backlash");
  EXPECT_EQ(between(growth, lead, 10.0, false), Between::rival_takes_the_place);
  EXPECT_EQ(between(growth, lead, -10.0, false), Between::both_in_question);
  EXPECT_EQ(between(growth, lead, -300.0, true), Between::named_stays);
  EXPECT_EQ(between(lead, growth, of_consequence_nats / 2.0, false), Between::named_stays);
  EXPECT_EQ(between(lead, growth, 50.0, false), Between::both_in_question);
  EXPECT_EQ(between(lead, growth, 300.0, true), Between::rival_takes_the_place);
  EXPECT_EQ(between(growth, gap, 10.0, false), Between::both_in_question) << "neither is a case of the other";
}

TEST(FarWorse, IsNotWhatAModelRepeatsAsBadlyButWhatItComesNearerThanByChance) {
  EXPECT_TRUE(is_far_worse(0.16, 0.1, 0.05, 1.5));
  EXPECT_FALSE(is_far_worse(0.14, 0.1, 0.05, 1.5));
  EXPECT_FALSE(is_far_worse(0.16, 0.1, 0.12, 1.5)) << "which it repeats no better";
  EXPECT_TRUE(is_far_worse(0.028, 0.0068, 0.021, 1.5)) << "a stop: 4.1 times as far off, and repeated at 3";
}

TEST(Arbiter, ARivalThatSpoilsAChannelTakesNoPlace) {
  auto truth = plant::source_axis();
  truth.effects.push_back(tests::effect("backlash", {{"gap_m", 8e-6}}));
  tools::Case data;
  data.axis = plant::source_axis();
  data.fit.push_back(tests::make_recording(truth, {.motion = "triangle",
                                                   .settings = {.amplitude_m = 0.01, .speed_m_per_s = 0.02},
                                                   .duration_s = 3.0,
                                                   .scale_at_table = true}));
  const ForwardModel forward(data.fit, data);
  const Candidate gap{data.axis, {{&hypothesis("backlash"), {8e-6, 0.0, std::log(2e3)}}}},
      yields{data.axis, {{&hypothesis("screw_compliance"), {1e-8, std::log(2e3)}}}};
  EXPECT_TRUE(spoils_a_channel(forward, yields, gap));
  EXPECT_FALSE(spoils_a_channel(forward, gap, gap));
  EXPECT_FALSE(spoils_a_channel(forward, gap, yields));
}

/// Runs with a delay of the command, and what the arbiter says of it.
Found settled_delay(double delay_s) {
  auto truth = plant::source_axis();
  truth.effects.push_back(tests::effect("input_delay", {{"delay_s", delay_s}}));
  const tools::Case data = tests::short_case(truth, plant::source_axis());
  const InverseModel model(make_tracks(data.fit, data.axis), data.axis);
  const Fitter fitter(model, data.axis);
  SearchResult result;
  result.whitening = fitter.colour_of(model.residual(data.axis, {}));
  Fit fit = fitter.fit({data.axis, {{&hypothesis("input_delay"), {delay_s}}}}, result.whitening, 6);
  result.found.emplace_back().effect = fit.model.effects[0];
  (void)Arbiter(ForwardModel(data.fit, data), fitter, silent).settle(result, fit);
  return result.found[0];
}

TEST(Arbiter, TellsADelayFromALagThatIsSeenInTheNextSampleAndNoShorterOne) {
  const auto is_lag = [](const Hypothesis* one) { return one->id == "current_loop_lag"; };
  const Found longer = settled_delay(8e-4), shorter = settled_delay(1.8e-4);
  EXPECT_EQ(longer.effect.hypothesis->id, "input_delay");
  EXPECT_TRUE(std::ranges::none_of(longer.rivals, is_lag));
  EXPECT_TRUE(std::ranges::any_of(shorter.rivals, is_lag) || is_lag(shorter.effect.hypothesis));
  EXPECT_FALSE(shorter.rivals.empty());
}

TEST(Contest, WhoIsBehindAlsoGoesOnFromTheOthersNumbersHoweverFarBehind) {
  const Cogged made;
  const Candidate right{made.data.axis, {{&hypothesis("cogging"), {0.01, 0.0, 8.0}}}};
  Candidate astray = right;  // where a search of its own had gone
  for (auto* contact : {&astray.axis.ball_screw, &astray.axis.guide}) contact->coulomb_N = {1.0, 1.0};
  const auto ruling = [&made](const Candidate& model) {
    Ruling now{made.fitter.linearised(model, made.whitening), model, likelihood(made.forward, extended(model)), 0.0, {}};
    now.value = now.likelihood.total();
    return now;
  };
  Ruling behind = ruling(astray), ahead = ruling({made.data.axis, {{&hypothesis("torque_ripple"), {0.05, 0.0, 8.0}}}});
  ASSERT_GT(ahead.value - behind.value, 1500.0);
  contest(behind, ahead, made.forward, made.fitter);
  EXPECT_GT(behind.value, ahead.value);
}

TEST(Ruling, OneEffectMoreThatStartsAstrayStartsFromNoneInstead) {
  const Cogged made;
  const Ruling before = rule(made.fitter.linearised(made.nominal, made.whitening), made.forward, made.fitter);
  // more than the motor can turn against
  const Fit astray = made.fitter.linearised({made.data.axis, {{&hypothesis("cogging"), {3.0, 3.0, 8.0}}}}, made.whitening);
  EXPECT_LT(rule_beside(before, astray, made.forward, made.fitter, SlopesOf::anew).value, before.value);
  const Ruling found = rule_with_one_more(before, astray, 0, made.forward, made.fitter);
  EXPECT_GT(found.value, before.value + 100.0);
  EXPECT_NEAR(found.model.effects[0].q[0], 0.01, 1e-3);
}

TEST(Ruling, WhatIsHopelesslyBehindIsPolishedNoFurtherAndWhatIsNotToTheEnd) {
  const Cogged made;
  Candidate off{made.data.axis, {{&hypothesis("cogging"), {0.007, 0.0, 8.0}}}};
  for (auto* friction_N : {&off.axis.ball_screw.coulomb_N, &off.axis.ball_screw.static_N})
    friction_N->pos *= 1.5, friction_N->neg *= 1.5;
  const Fit fit = made.fitter.linearised(off, made.whitening);
  const Ruling alone = rule(fit, made.forward, made.fitter);
  EXPECT_EQ(rule(fit, made.forward, made.fitter, alone.value).value, alone.value) << "it ends level";
  const Ruling behind = rule(fit, made.forward, made.fitter, alone.value + 1e7);
  EXPECT_LT(behind.value, alone.value - 1.0);
  EXPECT_GT(behind.value, rule_as_it_is(fit, made.forward, made.fitter).value) << "not before a step was taken";
}

TEST(Ruling, TheSameModelIsPolishedTheSameWayOnce) {
  const Cogged made;
  Candidate model{made.data.axis, {{&hypothesis("cogging"), {0.007, 0.0, 8.0}}}};
  const Fit fit = made.fitter.linearised(model, made.whitening);
  const Ruling one = rule(fit, made.forward, made.fitter), again = rule(fit, made.forward, made.fitter);
  EXPECT_EQ(again.seen.slopes, one.seen.slopes) << "slopes seen anew are others";
  EXPECT_EQ(again.model, one.model);
  EXPECT_EQ(again.value, one.value);
  EXPECT_EQ(again.fit.cost, fit.cost);
  model.effects[0].q[0] = 0.0071;
  EXPECT_NE(rule(made.fitter.linearised(model, made.whitening), made.forward, made.fitter).seen.slopes, one.seen.slopes);
  EXPECT_NE(rule(fit, made.forward, made.fitter, one.value).seen.slopes, one.seen.slopes) << "another way";
}

TEST(Confirm, WhatTheClosedLoopItselfHasNamedIsNotAsked) {
  const Cogged made;
  for (const bool by_closed_loop : {false, true}) {
    Fit fit = made.fitter.linearised({made.data.axis, {{&hypothesis("torque_ripple"), {0.05, 0.0, 3.0}}}}, made.whitening);
    SearchResult result;
    result.whitening = made.whitening;
    result.found.emplace_back().effect = fit.model.effects[0];
    result.found[0].by_closed_loop = by_closed_loop;
    keep_confirmed(made.forward, made.fitter, result, fit, silent);
    EXPECT_EQ(result.found.size(), by_closed_loop ? 1U : 0U);
    EXPECT_EQ(fit.model.effects.size(), result.found.size());
  }
}

// Numbers of the inverse model may be so far off that the simulation is as bad without the name.
TEST(Confirm, WhatAllUnseenFoldsBearOutIsAskedOnceMoreWithBothPolished) {
  const Cogged made;
  Candidate off{made.data.axis, {{&hypothesis("cogging"), {0.01, 0.0, 8.0}}}};
  for (auto* friction_N : {&off.axis.ball_screw.coulomb_N, &off.axis.ball_screw.static_N})
    friction_N->pos *= 1.5, friction_N->neg *= 1.5;
  const auto left_of = [&](const Active& active, bool held_everywhere) {
    off.effects = {active};
    Fit fit = made.fitter.linearised(off, made.whitening);
    SearchResult result;
    result.whitening = made.whitening;
    result.found.emplace_back().effect = active;
    result.found[0].held_everywhere = held_everywhere;
    keep_confirmed(made.forward, made.fitter, result, fit, silent);
    return result.found.size();
  };
  EXPECT_EQ(left_of({&hypothesis("cogging"), {0.01, 0.0, 8.0}}, true), 1U);
  EXPECT_EQ(left_of({&hypothesis("cogging"), {0.01, 0.0, 8.0}}, false), 0U) << "then this test shows nothing";
  EXPECT_EQ(left_of({&hypothesis("torque_ripple"), {0.05, 0.0, 3.0}}, true), 0U);
}

TEST(Missed, ANameThatTheClosedLoopDoesAsWellWithoutIsTakenBackAndTheRightOneStays) {
  const Cogged made;
  Candidate model{made.data.axis,
                  {{&hypothesis("local_friction"), {1.0, 0.004, 0.002, 0.0}}, {&hypothesis("cogging"), {0.01, 0.0, 8.0}}}};
  Fit fit = made.fitter.linearised(model, made.whitening);
  SearchResult result;
  result.whitening = made.whitening;
  for (const auto& effect : model.effects) result.found.emplace_back().effect = effect;
  Ruling settled = rule(fit, made.forward, made.fitter);
  keep_missed(made.forward, made.fitter, result, fit, settled, silent);
  ASSERT_EQ(fit.model.effects.size(), 1U);
  EXPECT_EQ(fit.model.effects[0].hypothesis->id, "cogging");
  ASSERT_EQ(result.found.size(), 1U);
  EXPECT_EQ(result.found[0].effect.hypothesis->id, "cogging");
  EXPECT_EQ(settled.model.effects.size(), 1U);
}

TEST(Missed, ANameStaysThoughTheModelWithItHadGoneAstray) {
  const Cogged made;
  const Candidate right{made.data.axis, {{&hypothesis("cogging"), {0.01, 0.0, 8.0}}}};
  Candidate astray = right;
  for (auto* contact : {&astray.axis.ball_screw, &astray.axis.guide}) contact->coulomb_N = {1.0, 1.0};
  Fit fit = made.fitter.linearised(right, made.whitening);
  SearchResult result;
  result.whitening = made.whitening;
  result.found.emplace_back().effect = right.effects[0];
  Ruling settled{fit, astray, likelihood(made.forward, extended(astray)), 0.0, {}};
  const double value = settled.value = settled.likelihood.total();
  keep_missed(made.forward, made.fitter, result, fit, settled, silent);
  EXPECT_EQ(result.found.size(), 1U);
  EXPECT_EQ(fit.model.effects.size(), 1U);
  EXPECT_GT(settled.value, value + 1000.0);
  EXPECT_GT(result.found[0].missed_nats, 100.0);
}

TEST(Missed, ANameThatShrinksToNothingGoesHoweverMuchItIsMissed) {
  const Cogged made;
  const Candidate both{made.data.axis,
                       {{&hypothesis("torque_gain_error"), {0.005}}, {&hypothesis("cogging"), {0.01, 0.0, 8.0}}}};
  Fit fit = made.fitter.linearised(both, made.whitening);
  SearchResult result;
  result.whitening = made.whitening;
  for (const auto& effect : both.effects) {
    result.found.emplace_back().effect = effect;
    result.found.back().by_closed_loop = false;
  }
  Ruling settled = rule(fit, made.forward, made.fitter);
  settled.value += 1e6;  // as if each were missed that much
  keep_missed(made.forward, made.fitter, result, fit, settled, silent);
  ASSERT_EQ(result.found.size(), 1U);
  EXPECT_EQ(result.found[0].effect.hypothesis->id, "cogging");
}

TEST(Missed, ANameThatTheRunsAloneToldGoesWhereItHasOutgrownThat) {
  const auto left_of = [](bool by_runs_alone, double gain) {
    const Cogged made;
    const Candidate both{made.data.axis,
                         {{&hypothesis("torque_gain_error"), {gain}}, {&hypothesis("cogging"), {0.01, 0.0, 8.0}}}};
    Fit fit = made.fitter.linearised(both, made.whitening);
    SearchResult result;
    result.whitening = made.whitening;
    for (const auto& effect : both.effects) {
      result.found.emplace_back().effect = effect;
      result.found.back().by_runs_alone = by_runs_alone;
    }
    Ruling settled{fit, both, likelihood(made.forward, extended(both)), 1e6, {}};  // as if each were missed that much
    keep_missed(made.forward, made.fitter, result, fit, settled, silent);
    return result.found.size();
  };
  EXPECT_EQ(left_of(true, 0.08), 2U);
  EXPECT_EQ(left_of(true, 0.16), 1U);
  EXPECT_EQ(left_of(false, 0.16), 2U);
}

}  // namespace
}  // namespace feedtwin

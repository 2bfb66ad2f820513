// What to record next: the chance that a move tells two models apart, and what is suspected but too weak to be named.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/made_case.h"
#include "tools/diagnose/diagnosis.h"
#include "tools/diagnose/planning/separation.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;
const auto silent = [](std::string_view) {};

TEST(ChanceToTell, GrowsFromNoneToCertainty) {
  EXPECT_EQ(chance_to_tell(0.0), 0.0);
  EXPECT_EQ(chance_to_tell(std::nan("")), 0.0);
  double last = 0.0;
  for (double d = 0.1; d < 12.0; d += 0.1) {  // NOLINT(bugprone-float-loop-counter): a sweep
    EXPECT_GE(chance_to_tell(d), last) << d;
    last = chance_to_tell(d);
  }
  EXPECT_LT(chance_to_tell(1.0), 0.01);
  EXPECT_NEAR(chance_to_tell(std::sqrt(2.0 * std::log(20.0))), 0.5, 1e-12);
  EXPECT_GT(last, 0.99);
}

/// Runs of the source's axis with an effect, and the model that holds it.
struct Known {
  tools::Case data;
  InverseModel model;
  Fitter fitter;
  ForwardModel forward;
  Whitening whitening;
  Candidate truth;

  Known(const plant::EffectSetting& effect, const Active& same)
      : data(case_of(effect)),
        model(make_tracks(data.fit, data.axis), data.axis),
        fitter(model, data.axis),
        forward(data.fit, data),
        truth{data.axis, {same}} {
    whitening = Whitening::estimate(model, model.residual(truth.axis, truth.effects));
  }
  static tools::Case case_of(const plant::EffectSetting& effect) {
    auto truth = plant::source_axis();
    truth.effects.push_back(effect);
    return tests::short_case(truth, plant::source_axis());
  }
  [[nodiscard]] Contender contender(const Candidate& candidate) const {
    return {candidate, fitter.linearised(candidate, whitening).covariance};
  }
};

TEST(Separation, IsNothingBetweenAModelAndItselfAndLargeWhereAnEffectIsMissing) {
  const Active cogging{&hypothesis("cogging"), {0.01, 0.0, 8.0}};
  const Known known(tests::effect("cogging", {{"amplitude_Nm", 0.01}, {"cycles_per_rev", 8.0}}), cogging);
  const Separation separation(known.forward, known.fitter, known.truth, std::nullopt);
  const Move& move = moves()[0];
  EXPECT_NEAR(separation.distance(move, known.truth, known.contender(known.truth), true), 0.0, 1e-9);
  const Contender without = known.contender({known.data.axis, {}});
  const double fixed = separation.distance(move, known.truth, without, false),
               bent = separation.distance(move, known.truth, without, true);
  EXPECT_GT(chance_to_tell(bent), 0.99);
  EXPECT_LE(bent, fixed) << "a model that may bend comes closer";
}

TEST(NextExperiment, WhatShakesTheTableIsToldFromAProcessByStoppingTheProcess) {
  const Active process{&hypothesis("process_force"), {4.0, 0.0, 4.0, 0.0, 0.0, 0.0, 0.0, 0.0, 42.0}};
  const Known known(tests::effect("process_force", {{"amplitude_N", 4.0}, {"frequency_Hz", 42.0}}), process);
  const auto next = plan_to_separate({known.data, known.forward, known.fitter, known.whitening, known.truth},
                                     *process.hypothesis, {"floor_vibration"}, silent);
  EXPECT_EQ(next.separates, (std::vector<std::string>{"process_force", "floor_vibration"}));
  EXPECT_NE(next.move.find("process stopped"), std::string::npos) << next.move;
  ASSERT_TRUE(next.p_resolve.has_value());
  EXPECT_GT(*next.p_resolve, 0.95);
}

TEST(Diagnosis, WhatIsRealAndTooWeakToBeNamedIsSaidToBeSo) {
  auto truth = plant::source_axis();
  truth.effects.push_back(tests::effect("rev_ripple", {{"amplitude_N", 0.125}, {"cycles_per_rev", 3.4}}));
  const auto found = diagnose(tests::short_case(truth, plant::source_axis()), silent);
  EXPECT_EQ(found.verdict, "cannot-tell");
  EXPECT_TRUE(found.effects.empty());
  ASSERT_FALSE(found.suspects.empty());
  EXPECT_EQ(found.suspects[0].hypothesis->id, "rev_ripple");
  EXPECT_EQ(found.next.separates[0], "rev_ripple");
  EXPECT_FALSE(found.next.move.empty());
  ASSERT_TRUE(found.next.p_resolve.has_value());
  EXPECT_GE(*found.next.p_resolve, 0.0);
  EXPECT_LE(*found.next.p_resolve, 1.0);
  EXPECT_NE(found.summary.find("too weak"), std::string::npos) << found.summary;
}

}  // namespace
}  // namespace feedtwin

// The second engine's judgement between confused explanations, and what its likelihoods and the noise's colour rest on.

#include "tools/diagnose/forward/arbiter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/made_case.h"
#include "tools/diagnose/forward/extended_axis.h"

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

TEST(RepeatableStructure, FindsWhatRepeatsAndNothingInNoise) {
  std::vector<tools::Recording> runs;
  for (const char* motion : {"sine", "triangle"})
    runs.push_back(tests::make_recording(plant::source_axis(), {.motion = motion, .duration_s = 8.0}));
  const InverseModel model(make_tracks(runs, plant::source_axis()), plant::source_axis());
  const RepeatableStructure structure(model);
  std::mt19937 random(11);  // NOLINT(bugprone-random-generator-seed): the same runs every time
  std::normal_distribution<double> normal;
  Vector noise(model.rows()), force(model.rows());
  for (const auto& s : model.segments())
    for (Index i = 0; i < s.size; ++i) {
      const double x = model.tracks()[s.run].position_m[model.sample_of(s, i)];
      noise[s.start + i] = normal(random);
      force[s.start + i] = 400.0 * x;  // a spring
    }
  EXPECT_LT(structure.part_of(noise).norm(), 0.3 * noise.norm());
  EXPECT_LT(structure.remaining(noise).share, 0.05);
  const Vector both = noise + force;
  EXPECT_GT(structure.remaining(both).share, 0.3);
  EXPECT_LT((both - structure.part_of(both)).norm(), 0.9 * both.norm());
}

}  // namespace
}  // namespace feedtwin

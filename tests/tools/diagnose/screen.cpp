// What the screen sees of laws that no short step shows.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/made_case.h"
#include "tests/tools/diagnose/fitted_runs.h"
#include "tools/diagnose/whole_number.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

// Friction turns round within a sample or two: what a derivative sees of it is over long before the reading comes.
TEST(Screen, SeesASensorThatIsManySamplesLate) {
  constexpr double late_s = 7e-3;
  auto truth = plant::source_axis();
  truth.effects.push_back(tests::effect("channel_skew", {{"torque_sensor_delay_s", 0.0}, {"force_sensor_delay_s", late_s}}));
  const std::vector<tools::Recording> runs{tests::make_recording(
      truth, {.settings = {.amplitude_m = 0.004, .speed_m_per_s = 0.05}, .torque_noise_Nm = 5e-4, .force_noise_N = 0.05})};
  const tests::FittedRuns of(runs, plant::source_axis(), 2);
  const auto scores = screen(of.fitter, of.fit, of.whitening).scores;
  const auto skew = std::ranges::find(scores, "channel_skew", [](const Score& s) { return s.hypothesis->id; });
  ASSERT_NE(skew, scores.end());
  EXPECT_EQ(skew, scores.begin());
  const Fit refitted = fit_with(of.fitter, of.fit.model, *skew, 0, of.whitening, 6);
  EXPECT_NEAR(refitted.model.effects[0].q[1], late_s, 0.05 * late_s);
  EXPECT_GT(skew->gain, 0.5 * (of.fit.cost - refitted.cost));
}

/// A torque ripple of order 12 that leaves a tenth of a newton, as the motions of a practice case show it.
std::vector<tools::Recording> rippling() {
  auto truth = plant::source_axis();
  truth.effects.push_back(
      tests::effect("torque_ripple", {{"relative_amplitude", 0.0135}, {"cycles_per_rev", 12.0}, {"phase_rad", -0.8}}));
  std::vector<tools::Recording> runs;
  for (const double speed : {0.15, 0.03})
    runs.push_back(tests::make_recording(truth, {.motion = "sine",
                                                 .settings = {.amplitude_m = 0.02, .speed_m_per_s = speed},
                                                 .duration_s = 6.0,
                                                 .torque_noise_Nm = 5e-4,
                                                 .force_noise_N = 0.05,
                                                 .seed = static_cast<unsigned>(1000.0 * speed)}));
  return runs;
}

// Over a fifth of a second at this speed a ripple of order 3.37 and one of order 3.5 are nearly the same.
TEST(Screen, ARippleIsNoNoiseForItsNeighbours) {
  auto truth = plant::source_axis();
  truth.effects.push_back(
      tests::effect("rev_ripple", {{"amplitude_N", 3.0}, {"cycles_per_rev", 3.375}, {"phase_rad", 0.4}}));
  const std::vector runs{tests::make_recording(
      truth,
      {.motion = "sine", .settings = {.amplitude_m = 0.01, .speed_m_per_s = 0.02}, .duration_s = 8.0, .sensors = false})};
  const tests::FittedRuns of(runs, plant::source_axis(), 2);
  const Screen screened = screen(of.fitter, of.fit, of.whitening);
  const auto ripple = std::ranges::find(screened.scores, "rev_ripple", [](const Score& s) { return s.hypothesis->id; });
  ASSERT_NE(ripple, screened.scores.end());
  EXPECT_GT(ripple->gain, 0.2 * ripple->touched);
  EXPECT_GT(ripple->standard, 100.0) << "36.7 where its neighbours' noise holds it";
}

// What a name explains is no more there for its rivals; what is, they say of another thing.
TEST(Screen, KnowsWhatIsLeftToAHypothesisAsBefore) {
  const auto score = [](const char* id, double gain) {
    Score one;
    one.hypothesis = &hypothesis(id);
    one.gain = gain;
    return one;
  };
  Screen last;
  last.scores = {score("screw_growth", 261.0), score("torque_gain_error", 20.0)};
  EXPECT_TRUE(last.leaves_to(score("screw_growth", 261.0)));
  EXPECT_FALSE(last.leaves_to(score("torque_gain_error", 72.0)));
  EXPECT_FALSE(last.leaves_to(score("backlash", 100.0)));
}

TEST(WholeNumber, TheOneThatHoldsOnUnseenStretchesIsTaken) {
  const tests::FittedRuns of(rippling(), plant::source_axis(), 2);
  const auto order_from = [&](double first, double also) {
    const Score score{.hypothesis = &hypothesis("torque_ripple"), .q = {0.0, 0.0, first}, .also = {{0.0, 0.0, also}}};
    return fit_with_whole_number(of.fitter, of.fit, score, of.whitening, Bar{}, 6).model.effects.back().q[2];
  };
  EXPECT_EQ(order_from(35.0, 12.0), 12.0);
  EXPECT_EQ(order_from(12.0, 35.0), 12.0);
}

}  // namespace
}  // namespace feedtwin

// What the screen sees of laws that no short step shows.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/made_case.h"
#include "tools/diagnose/search.h"

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
  const InverseModel model(make_tracks(runs, plant::source_axis()), plant::source_axis());
  const Fitter fitter(model, plant::source_axis());
  Whitening whitening = fitter.colour_of(model.residual(plant::source_axis(), {}));
  const Fit fit = fitter.fit_with_colour({plant::source_axis(), {}}, whitening, 2, 6);
  const auto scores = screen(fitter, fit, whitening).scores;
  const auto skew = std::ranges::find(scores, "channel_skew", [](const Score& s) { return s.hypothesis->id; });
  ASSERT_NE(skew, scores.end());
  EXPECT_EQ(skew, scores.begin());
  const Fit refitted = fit_with(fitter, fit.model, *skew, 0, whitening, 6);
  EXPECT_NEAR(refitted.model.effects[0].q[1], late_s, 0.05 * late_s);
  EXPECT_GT(skew->gain, 0.5 * (fit.cost - refitted.cost));
}

}  // namespace
}  // namespace feedtwin

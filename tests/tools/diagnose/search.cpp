// What the inverse model asks for, before the closed loop has its say.

#include "tools/diagnose/search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/made_case.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

plant::AxisParameters with_friction(plant::AxisParameters axis, double factor) {
  for (auto* contact : {&axis.ball_screw, &axis.guide})
    for (auto* number : {&contact->coulomb_N, &contact->static_N, &contact->viscous_Ns_per_m})
      number->pos *= factor, number->neg *= factor;
  return axis;
}

// Beside a file's numbers that are far off one strike among seconds of motion is little, and what chance does to an event is
// the event itself: it is asked for beside the recalibrated numbers, before all others are.
TEST(Search, AStopThatIsStruckOnceIsFoundFirstBesideTheRecalibratedNumbers) {
  constexpr double position_m = 0.0198, stiffness_N_per_m = 2e5;
  auto truth = plant::source_axis();
  truth.effects.push_back(tests::effect("hard_stop", {{"position_m", position_m},
                                                      {"direction", 1.0},
                                                      {"stiffness_N_per_m", stiffness_N_per_m},
                                                      {"damping_Ns_per_m", 1e4}}));
  const auto nominal = with_friction(plant::source_axis(), 1.6);
  auto data = tests::short_case(truth, nominal);
  for (const unsigned run : {2U, 3U, 4U}) {
    tests::MadeRun short_of_it{.motion = "s_curve", .duration_s = 4.0, .sensors = false, .seed = 9 + run};
    short_of_it.settings.amplitude_m = 0.015;
    short_of_it.settings.speed_m_per_s = 0.02 * run;
    data.fit.push_back(tests::make_recording(truth, short_of_it));
  }
  const InverseModel model(make_tracks(data.fit, nominal), nominal);
  const Fitter fitter(model, nominal);
  std::vector<std::string> said;
  const auto result = search(fitter, Bar{}, [&said](std::string_view line) { said.emplace_back(line); });

  ASSERT_EQ(result.found.size(), 1U);
  const Active& stop = result.found.front().effect;
  ASSERT_EQ(stop.hypothesis->id, "hard_stop");
  EXPECT_NEAR(stop.q[2], position_m, 2e-5);
  EXPECT_NEAR(stop.q[0], stiffness_N_per_m, 0.05 * stiffness_N_per_m);
  const auto first = [&said](std::string_view begins) {
    return std::ranges::find_if(said, [begins](const std::string& line) { return line.starts_with(begins); });
  };
  ASSERT_NE(first("adding hard_stop"), said.end());
  EXPECT_LT(first("adding hard_stop"), first("asking"));
}

}  // namespace
}  // namespace feedtwin

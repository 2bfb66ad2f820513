// What the inverse model's numbers take up, and the closed loop then misses.

#include "tools/diagnose/forward/second_look.h"

#include <gtest/gtest.h>

#include "tests/support/made_case.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

/// Runs with all sensors of an axis with these effects. What the second look names where the search named nothing.
std::vector<std::string_view> named_again(const std::vector<plant::EffectSetting>& effects,
                                          std::uint64_t most_samples = ForwardModel::usual_samples) {
  auto truth = plant::source_axis();
  truth.effects = effects;
  tools::Case data = tests::short_case(truth, plant::source_axis());
  unsigned seed = 1;
  for (auto& run : data.fit) {
    tests::MadeRun made{.motion = seed == 1 ? "sine" : "s_curve",
                        .duration_s = 3.0,
                        .scale_at_table = true,
                        .torque_noise_Nm = 5e-4,
                        .force_noise_N = 0.05,
                        .seed = seed};
    made.settings.speed_m_per_s = seed == 1 ? 0.08 : 0.05;
    made.settings.amplitude_m = 0.02;
    run = tests::make_recording(truth, made);
    ++seed;
  }
  const InverseModel model(make_tracks(data.fit, data.axis), data.axis);
  const Fitter fitter(model, data.axis);
  SearchResult found;
  found.whitening = fitter.colour_of(model.residual(data.axis, {}));
  Fit fit = fitter.fit_with_colour({data.axis, {}}, found.whitening, 2, 6);
  found.last = screen(fitter, fit, found.whitening);
  ForwardModel forward(data.fit, data, most_samples);
  const auto settled = look_again(forward, fitter, found, fit, std::nullopt, [](std::string_view) {});
  EXPECT_EQ(settled ? settled->model.effects.size() : 0U, found.found.size());
  EXPECT_EQ(fit.model.effects.size(), found.found.size());
  std::vector<std::string_view> names;
  for (const auto& one : found.found) names.push_back(one.effect.hypothesis->id);
  for (const auto& one : found.found) EXPECT_LT(one.p_false_alarm, 0.06) << "three deviations, of any hypothesis";
  return names;
}

TEST(SecondLook, NamesWhatTheNumbersTookUpAndTheClosedLoopMisses) {
  EXPECT_EQ(named_again({tests::effect("sensor_gain", {{"torque_sensor_gain", 0.93}})}),
            std::vector<std::string_view>{"sensor_gain"});
  // in motion it is another Coulomb friction each way; at rest it is not
  EXPECT_EQ(named_again({tests::effect("gravity", {{"force_N", 2.0}})}), std::vector<std::string_view>{"gravity"});
}

TEST(SecondLook, AsksNothingMoreOnceTheClosedLoopHasSimulatedAsMuchAsItMay) {
  const plant::EffectSetting weight = tests::effect("gravity", {{"force_N", 2.0}});
  EXPECT_EQ(named_again({weight}, 30'000), std::vector<std::string_view>{});
}

TEST(SecondLook, NamesNothingWhereEverythingIsSimulatedToItsNoise) {
  EXPECT_EQ(named_again({}), std::vector<std::string_view>{});
}

}  // namespace
}  // namespace feedtwin

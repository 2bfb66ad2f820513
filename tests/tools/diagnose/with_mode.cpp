// A part that rings, as the closed loop has it: its numbers are found from near, and what does not help is not put in.

#include "tools/diagnose/forward/with_mode.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/made_case.h"
#include "tools/diagnose/diagnosis.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

constexpr double mass_kg = 9.0, rings_at_Hz = 7.3, damping_ratio = 0.02;

plant::AxisParameters carrying_a_swing() {
  auto axis = plant::source_axis();
  axis.effects = {tests::effect("learned_mode",
                                {{"mass_kg", mass_kg}, {"frequency_Hz", rings_at_Hz}, {"damping_ratio", damping_ratio}})};
  return axis;
}

const plant::EffectSetting* swing_in(const plant::AxisParameters& axis) {
  const auto found = std::ranges::find(axis.effects, "learned_mode", &plant::EffectSetting::id);
  return found == axis.effects.end() ? nullptr : &*found;
}

TEST(WithMode, ItsNumbersAreThoseOfTheRuns) {
  const auto data = tests::short_case(carrying_a_swing(), plant::source_axis());
  const InverseModel model(make_tracks(data.fit, data.axis), data.axis);
  const Fitter fitter(model, data.axis);
  const ForwardModel forward(data.fit, data), held_out(data.holdout, data);
  Learned learned;
  learned.mode = Mode{.frequency_Hz = 1.02 * rings_at_Hz, .damping_ratio = 0.05, .mass_kg = 0.6 * mass_kg};
  const auto axis = with_mode(forward, fitter, {data.axis, {}}, learned);
  ASSERT_TRUE(learned.mode.has_value());
  EXPECT_NEAR(learned.mode->frequency_Hz, rings_at_Hz, 0.005 * rings_at_Hz);
  EXPECT_NEAR(learned.mode->mass_kg, mass_kg, 0.1 * mass_kg);
  EXPECT_NEAR(learned.mode->damping_ratio, damping_ratio, 0.5 * damping_ratio);
  ASSERT_NE(swing_in(axis), nullptr);
  EXPECT_EQ(swing_in(axis)->values.front(), learned.mode->mass_kg);
  EXPECT_LT(held_out.nrmse(axis).at("torque_cmd_Nm"), 0.2 * held_out.nrmse(data.axis).at("torque_cmd_Nm"));
}

TEST(WithMode, APartThatIsNotThereIsNotPutIn) {
  const auto data = tests::short_case(plant::source_axis(), plant::source_axis());
  const InverseModel model(make_tracks(data.fit, data.axis), data.axis);
  const Fitter fitter(model, data.axis);
  const ForwardModel forward(data.fit, data);
  for (const double kg : {mass_kg, -mass_kg}) {
    Learned learned;
    learned.mode = Mode{.frequency_Hz = rings_at_Hz, .damping_ratio = damping_ratio, .mass_kg = kg};
    const auto axis = with_mode(forward, fitter, {data.axis, {}}, learned);
    EXPECT_FALSE(learned.mode.has_value());
    EXPECT_EQ(swing_in(axis), nullptr);
  }
}

TEST(WithMode, TheDiagnosisToldUnknownRunsIt) {
  const auto data = tests::short_case(carrying_a_swing(), plant::source_axis());
  const auto found = diagnose(data, [](std::string_view) {});
  EXPECT_EQ(found.verdict, "unknown");
  EXPECT_TRUE(found.effects.empty());
  ASSERT_TRUE(found.unknown.has_value());
  EXPECT_EQ(found.unknown->axis, Where::frequency);
  ASSERT_NE(swing_in(found.updated), nullptr);
  const auto& torque = found.holdout.at("torque_cmd_Nm");
  EXPECT_LT(torque.after, 0.3 * torque.recalibrated);
}

}  // namespace
}  // namespace feedtwin

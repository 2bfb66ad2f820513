// How much of the command's jump the force sensor shows: told apart from a sensor that is late.

#include "tools/diagnose/command_jump.h"

#include <gtest/gtest.h>

#include "tests/support/made_case.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

double share_of(const plant::AxisParameters& truth) {
  auto nominal = plant::source_axis();
  nominal.guide_mass_kg *= 1.04;
  std::vector<tools::Recording> runs;
  for (const char* motion : {"sine", "triangle"})
    runs.push_back(tests::make_recording(truth, {.motion = motion, .duration_s = 6.0, .sensors = true}));
  return force_jump_share(runs, nominal);
}

plant::AxisParameters with(const plant::EffectSetting& effect) {
  auto axis = plant::source_axis();
  axis.effects.push_back(effect);
  return axis;
}

TEST(CommandJump, ARigidAxisShowsItWhole) {
  EXPECT_EQ(share_of(plant::source_axis()), 1.0);
}

TEST(CommandJump, BehindAYieldingScrewThereIsNone) {
  const double share = share_of(with(tests::effect("screw_compliance", {{"stiffness_N_per_m", 3e7}})));
  EXPECT_LT(share, 0.4);
  EXPECT_GT(share, -1.0);
}

// A stiff screw between two masses swings for half a millisecond after each jump.
TEST(CommandJump, BehindAStiffScrewThatSwingsThereIsNone) {
  EXPECT_LT(share_of(with(tests::effect("screw_compliance", {{"stiffness_N_per_m", 2e8}, {"damping_Ns_per_m", 500.0}}))),
            0.9);
}

// As late as that looks: read as a late sensor it leaves less over.
TEST(CommandJump, ASensorThatIsAsLateIsNoYieldingScrew) {
  EXPECT_EQ(
      share_of(with(tests::effect("channel_skew", {{"torque_sensor_delay_s", 4e-4}, {"force_sensor_delay_s", 1.3e-3}}))),
      1.0);
}

TEST(CommandJump, ALateSensorIsNoYieldingScrew) {
  EXPECT_EQ(share_of(with(tests::effect("channel_skew", {{"force_sensor_delay_s", 2e-3}}))), 1.0);
}

TEST(CommandJump, ALateCommandIsNoYieldingScrew) {
  EXPECT_EQ(share_of(with(tests::effect("input_delay", {{"delay_s", 8e-4}}))), 1.0);
}

}  // namespace
}  // namespace feedtwin

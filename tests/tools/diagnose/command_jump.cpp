// How much of the command's jump the force sensor shows: told apart from a sensor that is late.

#include "tools/diagnose/command_jump.h"

#include <gtest/gtest.h>

#include "tests/support/made_case.h"
#include "tools/diagnose/forward/forward_model.h"
#include "tools/diagnose/mended_case.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

double share_of(const plant::AxisParameters& truth, bool with_torque = true) {
  auto nominal = plant::source_axis();
  nominal.guide_mass_kg *= 1.04;
  std::vector<tools::Recording> runs;
  for (const char* motion : {"sine", "triangle"})
    runs.push_back(tests::make_recording(truth, {.motion = motion, .duration_s = 6.0, .sensors = true}));
  if (!with_torque)
    for (auto& run : runs) run.channels.erase("torque_sensor_Nm");
  return jump_shares(runs, nominal).force;
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

// The torque sensor would look late too; without it only what is left over tells.
TEST(CommandJump, NorIsItWithoutATorqueSensor) {
  EXPECT_EQ(share_of(with(tests::effect("input_delay", {{"delay_s", 4e-4}})), false), 1.0);
  EXPECT_LT(share_of(with(tests::effect("screw_compliance", {{"stiffness_N_per_m", 3e7}})), false), 0.4);
}

/// Of a table as heavy as motor and screw. @param before sensors are read before the row's command sets in
JumpShares of_a_heavy_table(const std::vector<plant::EffectSetting>& effects, bool before = true, bool with_force = true,
                            double motor_friction = 1.0) {
  auto truth = plant::source_axis();
  truth.guide_mass_kg = 90.0;
  truth.motor.coulomb_N.pos *= motor_friction, truth.motor.coulomb_N.neg *= motor_friction;
  auto nominal = truth;
  nominal.guide_mass_kg *= 1.04;
  truth.effects = effects;
  std::vector<tools::Recording> runs;
  for (const char* motion : {"sine", "triangle"})
    runs.push_back(tests::make_recording(truth, {.motion = motion, .duration_s = 6.0, .forces_before_command = before}));
  if (!with_force)
    for (auto& run : runs) run.channels.erase("force_sensor_N");
  return jump_shares(runs, nominal);
}

TEST(CommandJump, SensorsThatAreReadBeforeTheCommandAreTold) {
  for (const bool with_force : {true, false}) {
    const auto rigid = of_a_heavy_table({}, true, with_force);
    EXPECT_TRUE(rigid.before_command);
    EXPECT_NEAR(rigid.torque, -1.0, 0.05);
    EXPECT_NEAR(rigid.force, with_force ? -1.0 : 1.0, 0.05);
    EXPECT_FALSE(of_a_heavy_table({}, false, with_force).before_command);
  }
}

TEST(CommandJump, BehindAYieldingScrewTheyShowTheScrewsShareOfTheJumpBefore) {
  const auto screw = tests::effect("screw_compliance", {{"stiffness_N_per_m", 1e8}});
  const auto shares = of_a_heavy_table({screw});
  EXPECT_TRUE(shares.before_command);
  EXPECT_NEAR(shares.torque, -0.425, 0.15) << "of a rigid axis -1";
  EXPECT_NEAR(shares.force, 0.0, 0.3) << "the table's force does not jump";
  EXPECT_FALSE(of_a_heavy_table({screw}, false).before_command);
}

// By how late it looks it is not told there: what a motor's great friction takes over its path hides that.
TEST(CommandJump, SoTheyAreWhereTheMotorsFrictionSetsInOverAPath) {
  const auto over_a_path = tests::effect("motor_presliding", {{"distance_m", 3e-5}});
  for (const bool before : {true, false})
    EXPECT_EQ(of_a_heavy_table({over_a_path}, before, true, 20.0).before_command, before);
}

TEST(CommandJump, TheClosedLoopReadsThemBeforeTheCommandToo) {
  const auto truth = plant::source_axis();
  tools::Case data;
  data.axis = truth;
  data.fit.push_back(tests::make_recording(truth, {.motion = "sine", .duration_s = 4.0, .forces_before_command = true}));
  const ForwardModel forward(data.fit, data);
  const auto at_once = forward.nrmse(truth);
  note_reading(data, {.before_command = true});
  const auto before = forward.nrmse(truth);
  for (const char* sensor : {"torque_sensor_Nm", "force_sensor_N"})
    EXPECT_LT(before.at(sensor), 0.3 * at_once.at(sensor)) << sensor;
  EXPECT_EQ(before.at("torque_cmd_Nm"), at_once.at("torque_cmd_Nm"));
}

// One late by an eighth of a sample has both sensors show each jump a whole sample later.
TEST(CommandJump, ALateCommandIsNotReadBeforeIt) {
  for (const double delay_s : {9e-4, 1.25e-4})
    EXPECT_FALSE(of_a_heavy_table({tests::effect("input_delay", {{"delay_s", delay_s}})}, false).before_command) << delay_s;
}

TEST(CommandJump, ALateTorqueSensorBesideAForceSensorThatIsNotIsReadAfterTheCommand) {
  for (const double late_s : {1.0e-3, 1.4e-3}) {
    const auto late = tests::effect("channel_skew", {{"torque_sensor_delay_s", late_s}});
    EXPECT_FALSE(of_a_heavy_table({late}, false).before_command) << late_s;
  }
}

/// Without a force sensor.
double torque_share_of(const std::vector<plant::EffectSetting>& effects) {
  return of_a_heavy_table(effects, false, false).torque;
}

TEST(CommandJump, BehindAYieldingScrewTheTorqueSensorShowsWhatTheScrewsInertiaTakes) {
  // of the jump 1.5 / 5.5 at once; of one body, whose table has 90 kg at 5 mm a turn, 7.2 / 11.2
  EXPECT_NEAR(torque_share_of({tests::effect("screw_compliance", {{"stiffness_N_per_m", 1e8}})}), 0.425, 0.01);
}

TEST(CommandJump, ARigidHeavyTableShowsItWhole) {
  EXPECT_EQ(torque_share_of({}), 1.0);
}

TEST(CommandJump, ALateCommandOrSensorIsNoYieldingScrewForTheTorqueSensor) {
  EXPECT_EQ(torque_share_of({tests::effect("input_delay", {{"delay_s", 8e-4}})}), 1.0);
  EXPECT_EQ(torque_share_of({tests::effect("current_loop_lag", {{"time_constant_s", 1e-3}})}), 1.0);
  EXPECT_EQ(torque_share_of({tests::effect("channel_skew", {{"torque_sensor_delay_s", 2e-3}})}), 1.0);
}

}  // namespace
}  // namespace feedtwin

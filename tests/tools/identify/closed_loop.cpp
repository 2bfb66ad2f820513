#include "tools/identify/closed_loop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/made_case.h"
#include "tests/support/random_axis.h"

namespace feedtwin::tools {
namespace {

constexpr lanes::Wanted everything{true, true, true, true, true};

double rms_of_difference(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

double rms(std::span<const double> a) {
  return rms_of_difference(a, std::vector<double>(a.size()));
}

// Another instruction set, another lane, the server's own FeedAxis: one answer.
TEST(ClosedLoop, EveryKernelAgreesWithTheServersAxis) {
  std::mt19937_64 random(21);
  const auto recording = tests::make_recording(
      plant::source_axis(), {.settings = {.amplitude_m = 0.01, .speed_m_per_s = 0.05}, .duration_s = 1.0});
  for (const bool with_controller : {false, true}) {
    const ClosedLoopRun run(recording, plant::source_axis(),
                            with_controller ? std::optional(controllers::CascadeGains{}) : std::nullopt);
    std::vector<plant::AxisParameters> axes;
    for (int i = 0; i < 16; ++i) axes.push_back(tests::axis_near_source(random, 1.3));
    for (const auto& kernel : lanes::usable_kernels()) {
      for (std::size_t first = 0; first + kernel.width <= axes.size(); first += kernel.width) {
        std::vector<lanes::Candidate> candidates;
        for (std::size_t i = 0; i < kernel.width; ++i) {
          const auto& m = axes[first + i].motor;
          candidates.push_back({plant::make_axis_model(axes[first + i]), m.electrical_idle_W,
                                m.electrical_linear_Ws_per_m.pos, m.electrical_linear_Ws_per_m.neg,
                                m.electrical_quadratic_Ws2_per_m2.pos, m.electrical_quadratic_Ws2_per_m2.neg, 2e-8, 0.0,
                                0.0});
        }
        const std::size_t n = recording.size();
        std::vector<double> torque(n * kernel.width), position(torque), sensor(torque), force(torque), power(torque);
        kernel.run(run.view(), candidates.data(),
                   {kernel.width, torque.data(), position.data(), sensor.data(), force.data(), power.data()});
        for (std::size_t lane = 0; lane < kernel.width; ++lane) {
          plant::FeedAxis axis(axes[first + lane]);
          const auto alone = simulate_closed_loop(run, axis, 2e-8);
          for (std::size_t i = 0; i < n; ++i) {
            const std::size_t at = i * kernel.width + lane;
            SCOPED_TRACE(testing::Message() << kernel.instructions << " lane " << lane << " row " << i);
            ASSERT_NEAR(torque[at], alone.torque_Nm[i], 1e-9);
            ASSERT_NEAR(position[at], alone.position_m[i], 1e-9 * 0.01);
            ASSERT_NEAR(sensor[at], alone.torque_sensor_Nm[i], 1e-9);
            ASSERT_NEAR(force[at], alone.force_sensor_N[i], 1e-9 * 100.0);
            ASSERT_NEAR(power[at], alone.power_W[i], 1e-9 * 100.0);
          }
        }
      }
    }
  }
}

TEST(ClosedLoop, TheRightAxisGivesTheRecordedCommandBack) {
  for (const bool with_controller : {false, true}) {
    const auto recording = tests::make_recording(
        plant::source_axis(),
        {.settings = {.amplitude_m = 0.01, .speed_m_per_s = 0.05}, .duration_s = 1.0, .quantised = false});
    const ClosedLoopRun run(recording, plant::source_axis(),
                            with_controller ? std::optional(controllers::CascadeGains{}) : std::nullopt);
    const CandidateAxis right{plant::source_axis()};
    CandidateAxis wrong = right;
    wrong.parameters.ball_screw.coulomb_N.pos += 10.0;
    wrong.parameters.ball_screw.static_N.pos += 10.0;
    const auto simulated = simulate_closed_loop(run, std::vector{right, wrong}, everything);
    const auto command = recording.at(channel::torque_cmd_Nm);
    // the recording was made at a tenth of a count, the simulation runs at one
    EXPECT_LT(rms_of_difference(simulated[0].torque_Nm, command), 0.005 * rms(command)) << with_controller;
    EXPECT_LT(rms_of_difference(simulated[0].force_sensor_N, recording.at(channel::force_sensor_N)),
              0.02 * rms(recording.at(channel::force_sensor_N)));
    EXPECT_LT(rms_of_difference(simulated[0].torque_sensor_Nm, recording.at(channel::torque_sensor_Nm)),
              0.01 * rms(recording.at(channel::torque_sensor_Nm)));
    // 10 N at the table for half of the time is 5.6 mN m rms at the motor
    const double seen = rms_of_difference(simulated[1].torque_Nm, command);
    EXPECT_GT(seen, 0.004) << with_controller;
    EXPECT_LT(seen, 0.012) << with_controller;
  }
}

/// Another drive on the same axis.
plant::AxisParameters electrically_other(plant::AxisParameters axis, std::mt19937_64& random) {
  std::uniform_real_distribution<double> factor(0.2, 3.0);
  auto& motor = axis.motor;
  for (double* number :
       {&motor.electrical_idle_W, &motor.electrical_linear_Ws_per_m.pos, &motor.electrical_linear_Ws_per_m.neg,
        &motor.electrical_quadratic_Ws2_per_m2.pos, &motor.electrical_quadratic_Ws2_per_m2.neg})
    *number *= factor(random);
  return axis;
}

TEST(ClosedLoop, OtherElectricalCoefficientsNeedNoOtherSimulation) {
  std::mt19937_64 random(31);
  const auto recording = tests::make_recording(
      plant::source_axis(), {.settings = {.amplitude_m = 0.01, .speed_m_per_s = 0.05}, .duration_s = 1.0});
  const ClosedLoopRun run(recording, plant::source_axis(), std::nullopt);
  for (const bool yields : {false, true}) {
    auto parameters = plant::source_axis();
    if (yields) parameters.effects.push_back(tests::effect("screw_compliance", {{"stiffness_N_per_m", 1e8}}));
    plant::FeedAxis axis(parameters);
    ElectricalTerms terms;
    const Simulated made = simulate_closed_loop(run, axis, 0.0, true, &terms);
    for (int i = 0; i < 10; ++i) {
      const auto other = electrically_other(parameters, random);
      ASSERT_EQ(without_electrical(parameters), without_electrical(other));
      plant::FeedAxis its_own(other);
      const Simulated expected = simulate_closed_loop(run, its_own);
      const Simulated found = with_electrical(made, terms, parameters.motor, other.motor);
      EXPECT_EQ(found.torque_Nm, expected.torque_Nm);
      EXPECT_LT(rms_of_difference(found.power_W, expected.power_W), 1e-9 * rms(expected.power_W));
      EXPECT_LT(rms_of_difference(found.instant_power_W, expected.instant_power_W), 1e-9 * rms(expected.instant_power_W));
      EXPECT_GT(rms_of_difference(made.power_W, expected.power_W), 1e-3 * rms(expected.power_W));
      EXPECT_GT(rms_of_difference(expected.instant_power_W, expected.power_W), 1e-3 * rms(expected.power_W));
    }
  }
}

TEST(ClosedLoop, WhereAnEffectShapesThePowerOnlyEqualAxesAreAlike) {
  std::mt19937_64 random(32);
  const auto plain = plant::source_axis();
  auto heavier = plain;
  heavier.guide_mass_kg += 1.0;
  EXPECT_NE(without_electrical(plain), without_electrical(heavier));
  for (const char* id : {"regeneration_clipped", "copper_loss"}) {
    auto shaped = plain;
    shaped.effects.push_back(tests::effect(id, {}));
    EXPECT_NE(without_electrical(shaped), without_electrical(electrically_other(shaped, random))) << id;
    EXPECT_NE(without_electrical(plain), without_electrical(shaped)) << id;
  }
}

// A run may begin at rest under torque, a tick before it, or in the middle of a motion: the simulation begins as the axis
// did.
TEST(ClosedLoop, BeginsAsTheAxisDid) {
  std::mt19937_64 random(23);
  std::uniform_real_distribution<double> torque(0.35, 0.9), speed(0.02, 0.2);
  constexpr double tick_s = 1e-3;
  constexpr int rows = 40;
  for (int i = 0; i < 60; ++i) {
    const bool moving = i % 3 == 1, later = i % 3 == 2;
    plant::FeedAxis axis(plant::source_axis());
    axis.place(0.0, moving ? speed(random) : 0.0);
    const double most_Nm = torque(random);
    const auto command_at = [&](int row) { return plant::AxisCommand{.torque_Nm = later && row == 0 ? 0.0 : most_Nm}; };
    Recording recording;
    recording.sample_s = tick_s;
    for (int k = 0; k < rows; ++k) {
      recording.channels[std::string(channel::torque_cmd_Nm)].push_back(command_at(k).torque_Nm);
      recording.channels[std::string(channel::position_m)].push_back(axis.shown_position_m());
      axis.step(command_at(k), tick_s);
    }
    const ClosedLoopRun run(recording, plant::source_axis(), std::nullopt);
    plant::FeedAxis again(plant::source_axis());
    const auto simulated = simulate_closed_loop(run, again);
    // half of a count a tick is 5 mN m in the stand-in's rate; to take one row's travel for its speed, 70 and more
    for (int k = 0; k < rows; ++k)
      ASSERT_NEAR(simulated.torque_Nm[static_cast<std::size_t>(k)], command_at(k).torque_Nm, 0.012)
          << (moving ? "moving" : "at rest") << ", row " << k << ", torque " << most_Nm;
  }
}

// A drive that compensates friction by its setpoint does so from when it is told to move, not from when the axis does: that
// is stuck until then. Where its setpoint runs ahead of the recorded motion it does so earlier still.
TEST(ClosedLoop, AHiddenCompensationActsFromWhenTheMotionIsTold) {
  constexpr int rows = 200, told = 100, ahead = 8;
  Recording recording;
  recording.sample_s = 1e-3;
  for (int k = 0; k < rows; ++k) {
    recording.channels[std::string(channel::torque_cmd_Nm)].push_back(0.0);
    recording.channels[std::string(channel::position_m)].push_back(k < told ? 0.0 : 5e-5 * (k - told));
  }
  const ClosedLoopRun run(recording, plant::source_axis(), std::nullopt);
  const auto simulated = [&](double lead_s) {
    auto parameters = plant::source_axis();
    parameters.effects.push_back(
        tests::effect("hidden_friction_compensation", {{"torque_Nm", 0.08}, {"speed_m_per_s", 1e-3}, {"lead_s", lead_s}}));
    plant::FeedAxis axis(parameters);
    return simulate_closed_loop(run, axis);
  };
  const auto at_once = simulated(0.0), led = simulated(0.02);
  EXPECT_NEAR(at_once.torque_sensor_Nm[told - ahead], 0.0, 1e-6);
  EXPECT_LT(std::abs(at_once.position_m[told]), 1e-5) << "still stuck";
  EXPECT_GT(at_once.torque_sensor_Nm[told], 0.01);
  EXPECT_GT(led.torque_sensor_Nm[told - ahead], 0.01);
}

TEST(ClosedLoop, AnyNumberOfThreadsGivesTheSame) {
  std::mt19937_64 random(22);
  const auto recording = tests::make_recording(plant::source_axis(), {.duration_s = 0.3});
  const ClosedLoopRun run(recording, plant::source_axis(), std::nullopt);
  std::vector<CandidateAxis> candidates;
  for (int i = 0; i < 19; ++i) candidates.push_back({tests::axis_near_source(random, 1.2)});
  const auto one = simulate_closed_loop(run, candidates, everything, 1),
             three = simulate_closed_loop(run, candidates, everything, 3);
  ASSERT_EQ(one.size(), candidates.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].torque_Nm, three[i].torque_Nm) << i;
    EXPECT_EQ(one[i].power_W, three[i].power_W) << i;
  }
}

TEST(MeteredPower, IsReadAsThePlantsMeterShowsIt) {
  const auto recording = tests::make_recording(plant::source_axis(), {.duration_s = 1.0});
  const auto shown = recording.at(channel::power_W);
  const auto meter = metered_rows(shown);
  EXPECT_EQ(meter.window, 100U);
  ASSERT_GE(meter.rows.size(), 8U);
  const ClosedLoopRun run(recording, plant::source_axis(), std::nullopt);
  const CandidateAxis right{plant::source_axis()};
  const auto simulated = simulate_closed_loop(run, std::span(&right, 1), everything);
  const auto metered = as_metered(simulated[0].power_W, meter);
  EXPECT_LT(rms_of_difference(metered, shown), 0.01 * rms(shown));
}

TEST(MeteredPower, EveryRowCountsWhereThePowerIsNotHeld) {
  std::vector<double> power{1, 2, 3, 2, 1, 2, 3};
  const auto meter = metered_rows(power);
  EXPECT_EQ(meter.window, 1U);
  EXPECT_EQ(as_metered(power, meter), power);
}

}  // namespace
}  // namespace feedtwin::tools

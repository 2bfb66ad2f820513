// What a channel shows that the axis does not do, and what a force that the model lacks is not.

#include "tools/diagnose/reading_structure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/support/made_case.h"
#include "tools/recording/power_meter.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;
namespace channel = tools::channel;

std::vector<tools::Recording> runs(double speed_m_per_s) {
  std::vector<tools::Recording> all;
  for (const char* motion : {"sine", "triangle", "s_curve"}) {
    tests::MadeRun made{.motion = motion,
                        .duration_s = 8.0,
                        .torque_noise_Nm = 5e-4,
                        .force_noise_N = 0.05,
                        .power_noise_W = 0.05,
                        .seed = static_cast<unsigned>(all.size() + 1)};
    made.settings.speed_m_per_s = speed_m_per_s, made.settings.amplitude_m = 0.02;
    all.push_back(tests::make_recording(plant::source_axis(), made));
  }
  return all;
}

using Change = std::function<void(tools::Recording&)>;

/// What stands out of runs that were changed so, by the true numbers.
struct Told {
  std::optional<ReadingStructure> out;
  std::vector<ReadingStructure> all;
};
Told told_of(const Change& change, double speed_m_per_s = 0.06) {
  auto changed = runs(speed_m_per_s);
  for (auto& run : changed) change(run);
  for (auto& run : changed) run.meter = tools::meter_habit(changed, plant::source_axis());
  const InverseModel model(make_tracks(changed, plant::source_axis()), plant::source_axis());
  const Candidate truth{plant::source_axis(), {}};
  return {what_stands_out(model, truth, [](std::string_view) {}), structure_of_readings(model, truth)};
}

void change(tools::Recording& run, std::string_view name, const std::function<double(double, std::size_t)>& to) {
  auto values = std::vector<double>(run.at(name).begin(), run.at(name).end());
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = to(values[k], k);
  run.channels[std::string(name)] = std::move(values);
}

TEST(ReadingStructure, NothingStandsOutOfAnAxisThatTheModelHolds) {
  const Told told = told_of([](tools::Recording&) {});
  EXPECT_EQ(told.all.size(), 5U);  // both sensors, command, scale, power
  EXPECT_FALSE(told.out.has_value());
  for (const auto& reading : told.all) EXPECT_LT(reading.share, 0.2) << reading.channel;
}

// A fan on the drive's supply, half of every 1.57 s.
TEST(ReadingStructure, ALoadThatKeepsTimeIsInThePower) {
  const Told told = told_of([](tools::Recording& run) {
    change(run, channel::power_W, [&](double p, std::size_t k) {
      const double t = static_cast<double>(k - k % 100) * run.sample_s + 0.4;
      return p + (std::fmod(t, 1.57) < 0.78 ? 1.0 : 0.0);
    });
  });
  ASSERT_TRUE(told.out.has_value());
  EXPECT_EQ(told.out->channel, channel::power_W);
  EXPECT_EQ(told.out->follows, Follows::time);
  EXPECT_NEAR(told.out->every, 1.57, 0.03);
  EXPECT_GT(told.out->share, 0.6);
}

TEST(ReadingStructure, ACoarseConverterStepsInWhatIsRead) {
  constexpr double step_Nm = 0.02;
  const Told told = told_of([](tools::Recording& run) {
    change(run, channel::torque_sensor_Nm, [](double y, std::size_t) { return step_Nm * std::round(y / step_Nm); });
  });
  ASSERT_TRUE(told.out.has_value());
  EXPECT_EQ(told.out->channel, channel::torque_sensor_Nm);
  EXPECT_EQ(told.out->follows, Follows::reading_by_step);
  EXPECT_NEAR(told.out->every, step_Nm, 0.02 * step_Nm);
}

TEST(ReadingStructure, WhatActsIsNotWhatWasCommandedStepByStep) {
  constexpr double step_Nm = 0.03, size_Nm = 0.004;
  constexpr double with_torques_of_all_sizes_m_per_s = 0.2;
  const Told told = told_of(
      [](tools::Recording& run) {
        change(run, channel::torque_cmd_Nm,
               [](double u, std::size_t) { return u + size_Nm * std::sin(2.0 * std::numbers::pi * u / step_Nm); });
      },
      with_torques_of_all_sizes_m_per_s);
  ASSERT_TRUE(told.out.has_value());
  EXPECT_EQ(told.out->channel, channel::torque_cmd_Nm);
  EXPECT_NEAR(told.out->every, step_Nm, 0.02 * step_Nm);
}

TEST(ReadingStructure, ASensorThatReadsACurveIsToldByBothEquations) {
  const Told told = told_of([](tools::Recording& run) {
    change(run, channel::force_sensor_N, [](double y, std::size_t) { return y + 2.0 * std::sin(y / 4.0); });
  });
  ASSERT_TRUE(told.out.has_value());
  EXPECT_EQ(told.out->channel, channel::force_sensor_N);
  EXPECT_GT(told.out->of_reading, 0.8);
}

// More friction of the screw along the travel: command and torque sensor show it alike.
TEST(ReadingStructure, AForceThatTheModelLacksIsNoReading) {
  const Told told = told_of([](tools::Recording& run) {
    const auto place = std::vector<double>(run.at(channel::position_m).begin(), run.at(channel::position_m).end());
    for (const auto name : {channel::torque_cmd_Nm, channel::torque_sensor_Nm})
      change(run, name, [&](double y, std::size_t k) { return y + 0.005 * std::sin(place[k] / 0.004); });
  });
  EXPECT_FALSE(told.out.has_value());
}

}  // namespace
}  // namespace feedtwin

#include "tools/recording/power_meter.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/made_case.h"

namespace feedtwin::tools {
namespace {

std::vector<Recording> runs_of_the_plant(const plant::AxisParameters& axis = plant::source_axis()) {
  std::vector<Recording> runs;
  for (const double speed : {0.02, 0.06})
    runs.push_back(tests::make_recording(
        axis, {.motion = "sine", .settings = {.amplitude_m = 0.02, .speed_m_per_s = speed}, .duration_s = 6.0}));
  return runs;
}

TEST(MeterHabit, OfThePlantsMeterIsAllTimeOfTheRowsOwnTicks) {
  const auto habit = meter_habit(runs_of_the_plant(), plant::source_axis());
  EXPECT_EQ(habit.delay, 0U);
  EXPECT_FALSE(habit.instants);
}

// A ripple is no law of a drive yet, and what it leaves over hides most of the difference.
TEST(MeterHabit, IsToldBesideARipple) {
  auto axis = plant::source_axis();
  axis.effects.push_back(
      tests::effect("torque_ripple", {{"relative_amplitude", 0.085}, {"cycles_per_rev", 8.0}, {"phase_rad", 1.0}}));
  std::vector<Recording> runs;
  for (const double speed : {0.05, 0.15})
    runs.push_back(tests::make_recording(
        axis, {.motion = "sine", .settings = {.amplitude_m = 0.02, .speed_m_per_s = speed}, .duration_s = 8.0}));
  EXPECT_FALSE(meter_habit(runs, axis).instants);
}

TEST(MeterHabit, OfInstantsIsTold) {
  auto runs = runs_of_the_plant();
  tests::compute_power_from_command(runs, plant::source_axis());
  EXPECT_TRUE(meter_habit(runs, plant::source_axis()).instants);
}

// What acts between command and shaft shows in a measured power, and never in one that is computed from the command.
TEST(MeterHabit, WhatTheDriveComputesFromItsCommandIsTold) {
  for (const auto& acts : {tests::effect("torque_ripple", {{"relative_amplitude", 0.05}, {"cycles_per_rev", 2.0}}),
                           tests::effect("torque_gain_error", {{"relative_error", -0.05}}),
                           tests::effect("torque_offset", {{"offset_Nm", 0.02}}),
                           tests::effect("current_loop_lag", {{"time_constant_s", 3e-3}})}) {
    auto axis = plant::source_axis();
    axis.effects = {acts};
    auto runs = runs_of_the_plant(axis);
    EXPECT_FALSE(meter_habit(runs, plant::source_axis()).of_command) << acts.id;
    tests::compute_power_from_command(runs, plant::source_axis());
    EXPECT_TRUE(meter_habit(runs, plant::source_axis()).of_command) << acts.id;
  }
}

void read_a_row_later(std::vector<Recording>& runs) {
  for (auto& run : runs) {
    auto& power_W = run.channels.at(std::string(channel::power_W));
    power_W.insert(power_W.begin(), power_W.front());
    power_W.pop_back();
    run.meter.delay = 1;
  }
}

// Power that is not given back is beyond the laws of a drive, and a row's delay small beside it.
TEST(MeterHabit, IsToldOfADriveThatBurnsWhatComesBack) {
  auto axis = plant::source_axis();
  axis.effects.push_back(tests::effect("regeneration_clipped", {{"share", 1.0}}));
  for (const double amplitude_m : {0.005, 0.015, 0.04})
    for (const double speed_m_per_s : {0.1, 0.2, 0.4}) {
      std::vector<Recording> runs;
      for (const double share : {0.5, 1.0})
        runs.push_back(tests::make_recording(axis, {.motion = "s_curve",
                                                    .settings = {.amplitude_m = amplitude_m,
                                                                 .speed_m_per_s = share * speed_m_per_s,
                                                                 .acceleration_m_per_s2 = 12.0,
                                                                 .jerk_m_per_s3 = 2000.0,
                                                                 .dwell_s = 0.05},
                                                    .duration_s = 6.0}));
      EXPECT_EQ(meter_habit(runs, axis).delay, 0U) << amplitude_m << ", " << speed_m_per_s;
      read_a_row_later(runs);
      EXPECT_EQ(meter_habit(runs, axis).delay, 1U) << amplitude_m << ", " << speed_m_per_s;
    }
}

// Where a meter errs by a share of what it reads, its largest readings say the least about when they were taken.
TEST(MeterHabit, IsToldOfAMeterThatErrsByItsReading) {
  std::vector<Recording> runs;
  for (const double speed : {0.02, 0.25})
    runs.push_back(tests::make_recording(
        plant::source_axis(),
        {.motion = "sine", .settings = {.amplitude_m = 0.03, .speed_m_per_s = speed}, .duration_s = 8.0}));
  std::mt19937 random(7);
  std::normal_distribution<double> share(0.0, 0.0012);
  for (auto& run : runs) {
    auto& power_W = run.channels.at(std::string(channel::power_W));
    double shown = 0.0, off = 0.0;
    for (double& reading : power_W) {
      if (reading != shown) shown = reading, off = share(random);
      reading *= 1.0 + off;
    }
  }
  EXPECT_EQ(meter_habit(runs, plant::source_axis()).delay, 0U);
  read_a_row_later(runs);
  EXPECT_EQ(meter_habit(runs, plant::source_axis()).delay, 1U);
}

TEST(ErrorScale, IsOneWhereErrorsAreAlikeWhateverTheRunReads) {
  EXPECT_EQ(error_scale_W(40.0, 50.0, true), error_scale_W(1.0, 2.0, true));
  EXPECT_GT(error_scale_W(40.0, 50.0, false), 5.0 * error_scale_W(1.0, 2.0, false));
}

TEST(MeterHabit, TellsErrorsThatAreAlikeFromThoseOfReadings) {
  for (const bool alike : {true, false}) {
    std::vector<Recording> runs;
    for (const double speed : {0.02, 0.25})
      runs.push_back(tests::make_recording(
          plant::source_axis(),
          {.motion = "sine", .settings = {.amplitude_m = 0.03, .speed_m_per_s = speed}, .duration_s = 12.0}));
    std::mt19937 random(7);
    std::normal_distribution<double> unit;
    for (auto& run : runs) {
      double shown = 0.0, off_W = 0.0;
      for (double& reading : run.channels.at(std::string(channel::power_W))) {
        if (reading != shown) shown = reading, off_W = 0.02 * (alike ? 10.0 : shown) * unit(random);
        reading += off_W;
      }
    }
    EXPECT_EQ(meter_habit(runs, plant::source_axis()).errors_alike, alike);
  }
}

// Noise that leaves of all habits about as much: the likelier one is taken, and it is the right one.
TEST(MeterHabit, IsToldOfANoisyMeterToo) {
  for (const double noise_W : {0.05, 0.2, 0.8}) {
    std::vector<Recording> runs;
    for (const double speed : {0.05, 0.12, 0.25})
      runs.push_back(tests::make_recording(
          plant::source_axis(),
          {.motion = "s_curve", .settings = {.speed_m_per_s = speed, .acceleration_m_per_s2 = 4.0}, .duration_s = 10.0}));
    std::mt19937 random(7);  // NOLINT(bugprone-random-generator-seed): the same noise every time
    std::normal_distribution<double> noise(0.0, noise_W);
    for (auto& run : runs) {
      double shown = 0.0, off = 0.0;
      for (double& reading : run.channels.at(std::string(channel::power_W))) {
        if (reading != shown) shown = reading, off = noise(random);
        reading += off;
      }
    }
    EXPECT_EQ(meter_habit(runs, plant::source_axis()).delay, 0U) << noise_W;
    read_a_row_later(runs);
    EXPECT_EQ(meter_habit(runs, plant::source_axis()).delay, 1U) << noise_W;
  }
}

TEST(MeterHabit, OfAMeterThatShowsTheTicksBeforeTheRowIsOne) {
  auto runs = runs_of_the_plant();
  read_a_row_later(runs);
  EXPECT_EQ(meter_habit(runs, plant::source_axis()).delay, 1U);
  const auto meter = metered_rows(runs[0], plant::source_axis());
  EXPECT_EQ(meter.delay, 1U);
  EXPECT_EQ(meter.first_tick(meter.rows[0]) % meter.window, 0U);
}

TEST(MeterHabit, AWindowThatSpansSeveralReadingsIsTold) {
  for (const std::size_t readings : {1U, 3U}) {
    auto axis = plant::source_axis();
    axis.power_meter_window_s = 0.3, axis.power_meter_readings = static_cast<double>(readings);
    auto runs = runs_of_the_plant(axis);
    const auto habit = meter_habit(runs, plant::source_axis());
    EXPECT_EQ(habit.readings_a_window, readings);
    EXPECT_EQ(habit.delay, 0U);
    for (auto& run : runs) run.meter = habit;
    const auto meter = metered_rows(runs[0], plant::source_axis());
    EXPECT_EQ(meter.window, 300U);
    EXPECT_EQ(meter.rows[1] - meter.rows[0], 300U / readings);
    EXPECT_GE(meter.rows[0] + 1, meter.window);
  }
}

// What was commanded and not given looks like a part of the window.
TEST(MeterHabit, OfADriveThatSaturatesIsNoPartOfAWindow) {
  auto axis = plant::source_axis();
  axis.effects.push_back(tests::effect("torque_saturation", {{"limit_Nm", 0.3}}));
  std::vector<Recording> runs;
  for (const double speed : {0.1, 0.15, 0.2})
    runs.push_back(tests::make_recording(
        axis,
        {.motion = "s_curve", .settings = {.speed_m_per_s = speed, .acceleration_m_per_s2 = 3.0}, .duration_s = 10.0}));
  EXPECT_EQ(meter_habit(runs, plant::source_axis()).readings_a_window, 1.0);
}

TEST(MeterHabit, IsNotToldByAFewReadings) {
  auto runs = runs_of_the_plant();
  runs.resize(1);
  for (auto& [name, values] : runs[0].channels) values.resize(850);
  auto& power_W = runs[0].channels.at(std::string(channel::power_W));
  power_W.insert(power_W.begin(), power_W.front());  // what would be told from more
  power_W.pop_back();
  EXPECT_EQ(meter_habit(runs, plant::source_axis()).delay, 0U);
}

TEST(MeterHabit, NeedsReadingsToBeTold) {
  auto runs = runs_of_the_plant();
  for (auto& run : runs) run.channels.erase(std::string(channel::power_W));
  EXPECT_EQ(meter_habit(runs, plant::source_axis()).delay, 0U);
  EXPECT_TRUE(metered_rows(runs[0], plant::source_axis()).rows.empty());
  EXPECT_EQ(meter_habit({}, plant::source_axis()).delay, 0U);
}

}  // namespace
}  // namespace feedtwin::tools

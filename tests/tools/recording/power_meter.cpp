#include "tools/recording/power_meter.h"

#include <gtest/gtest.h>

#include "tests/support/made_case.h"

namespace feedtwin::tools {
namespace {

std::vector<Recording> runs_of_the_plant() {
  std::vector<Recording> runs;
  for (const double speed : {0.02, 0.06})
    runs.push_back(tests::make_recording(
        plant::source_axis(),
        {.motion = "sine", .settings = {.amplitude_m = 0.02, .speed_m_per_s = speed}, .duration_s = 6.0}));
  return runs;
}

TEST(MeterDelay, OfThePlantsMeterIsNone) {
  const auto runs = runs_of_the_plant();
  EXPECT_EQ(meter_delay(runs, plant::source_axis()), 0U);
}

void read_a_row_later(std::vector<Recording>& runs) {
  for (auto& run : runs) {
    auto& power_W = run.channels.at(std::string(channel::power_W));
    power_W.insert(power_W.begin(), power_W.front());
    power_W.pop_back();
    run.meter_delay = 1;
  }
}

// Power that is not given back is beyond the laws of a drive, and a row's delay small beside it.
TEST(MeterDelay, IsToldOfADriveThatBurnsWhatComesBack) {
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
      EXPECT_EQ(meter_delay(runs, axis), 0U) << amplitude_m << ", " << speed_m_per_s;
      read_a_row_later(runs);
      EXPECT_EQ(meter_delay(runs, axis), 1U) << amplitude_m << ", " << speed_m_per_s;
    }
}

TEST(MeterDelay, OfAMeterThatShowsTheTicksBeforeTheRowIsOne) {
  auto runs = runs_of_the_plant();
  read_a_row_later(runs);
  EXPECT_EQ(meter_delay(runs, plant::source_axis()), 1U);
  const auto meter = metered_rows(runs[0], plant::source_axis());
  EXPECT_EQ(meter.delay, 1U);
  EXPECT_EQ(meter.first_tick(meter.rows[0]) % meter.window, 0U);
}

TEST(MeterDelay, IsNotToldByAFewReadings) {
  auto runs = runs_of_the_plant();
  runs.resize(1);
  for (auto& [name, values] : runs[0].channels) values.resize(850);
  auto& power_W = runs[0].channels.at(std::string(channel::power_W));
  power_W.insert(power_W.begin(), power_W.front());  // what would be told from more
  power_W.pop_back();
  EXPECT_EQ(meter_delay(runs, plant::source_axis()), 0U);
}

TEST(MeterDelay, NeedsReadingsToBeTold) {
  auto runs = runs_of_the_plant();
  for (auto& run : runs) run.channels.erase(std::string(channel::power_W));
  EXPECT_EQ(meter_delay(runs, plant::source_axis()), 0U);
  EXPECT_TRUE(metered_rows(runs[0], plant::source_axis()).rows.empty());
  EXPECT_EQ(meter_delay({}, plant::source_axis()), 0U);
}

}  // namespace
}  // namespace feedtwin::tools

#include "tools/recording/repeated_readings.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/made_case.h"
#include "tools/recording/power_meter.h"

namespace feedtwin::tools {
namespace {

constexpr std::size_t window_rows = 200;

plant::AxisParameters slow_meter() {
  auto axis = plant::source_axis();
  axis.power_meter_window_s = 0.2;
  return axis;
}

std::vector<Recording> runs_of(const plant::AxisParameters& axis) {
  std::vector<Recording> runs;
  for (const double speed : {0.02, 0.06})
    runs.push_back(tests::make_recording(
        axis, {.motion = "sine", .settings = {.amplitude_m = 0.02, .speed_m_per_s = speed}, .duration_s = 6.0}));
  return runs;
}

/// Read so many times a window, each time with an error of its own.
void read_often(Recording& run, std::size_t readings) {
  std::mt19937 random(3);  // NOLINT(bugprone-random-generator-seed): the same noise every time
  std::normal_distribution<double> noise_W(0.0, 0.05);
  auto& power_W = run.channels.at(std::string(channel::power_W));
  const std::size_t rows = metered_rows(power_W).rows.front();
  double error_W = 0.0;
  for (std::size_t k = rows; k < power_W.size(); ++k) {
    if ((k - rows) % (window_rows / readings) == 0) error_W = noise_W(random);
    power_W[k] += error_W;
  }
}

TEST(RepeatedReadings, AreToldAndJoined) {
  for (const std::size_t readings : {2U, 4U}) {
    const auto quiet = runs_of(slow_meter());
    auto runs = quiet;
    for (auto& run : runs) read_often(run, readings);
    ASSERT_EQ(readings_of_one_window(runs), readings);
    for (std::size_t r = 0; r < runs.size(); ++r) {
      join_readings(runs[r], readings);
      const auto rows = metered_rows(quiet[r].at(channel::power_W)).rows;
      EXPECT_EQ(metered_rows(runs[r].at(channel::power_W)).rows, rows);
      for (const std::size_t row : rows)
        EXPECT_NEAR(runs[r].at(channel::power_W)[row], quiet[r].at(channel::power_W)[row], 0.25);
    }
  }
}

// A run may begin amid a window: what is left of it is not read.
TEST(RepeatedReadings, OfAWindowThatBeganBeforeTheRunAreLeftOut) {
  auto runs = runs_of(slow_meter());
  for (auto& run : runs) {
    read_often(run, 2);
    for (auto& [name, values] : run.channels) values.erase(values.begin(), values.begin() + 350);
  }
  ASSERT_EQ(readings_of_one_window(runs), 2U);
  join_readings(runs[0], 2);
  const auto meter = metered_rows(runs[0].at(channel::power_W));
  EXPECT_EQ(meter.window, window_rows);
  for (std::size_t i = 1; i < meter.rows.size(); ++i) EXPECT_EQ(meter.rows[i] - meter.rows[i - 1], window_rows);
}

TEST(RepeatedReadings, AreNoneOfANoisyMeterThatShowsEachWindowOnce) {
  auto runs = runs_of(slow_meter());
  for (auto& run : runs) read_often(run, 1);
  EXPECT_EQ(readings_of_one_window(runs), 1U);
  EXPECT_EQ(readings_of_one_window({}), 1U);
  for (auto& run : runs) run.channels.erase(std::string(channel::power_W));
  EXPECT_EQ(readings_of_one_window(runs), 1U);
}

}  // namespace
}  // namespace feedtwin::tools

// What a drive was told to reach, from what a recording shows of it.

#include "tools/identify/setpoint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/support/made_case.h"

namespace feedtwin::tools {
namespace {

constexpr double lag_s = 0.02, count_m = 7.6e-8, turns_rad_per_s = 2.0 * std::numbers::pi, stroke_m = 0.02;

double told_m_per_s(int row) {
  return stroke_m * turns_rad_per_s * std::cos(turns_rad_per_s * 1e-3 * row);
}

/// A position loop without feed-forward: x + T dx/dt follows the reference.
Recording behind(bool with_reference) {
  Recording recording;
  recording.sample_s = 1e-3;
  const double late_rad = std::atan(turns_rad_per_s * lag_s);
  for (int k = 0; k < 1000; ++k) {
    const double turned_rad = turns_rad_per_s * 1e-3 * k;
    const double at_m = stroke_m * std::cos(late_rad) * std::sin(turned_rad - late_rad);
    recording.channels[std::string(channel::position_m)].push_back(count_m * std::round(at_m / count_m));
    if (with_reference) recording.channels[std::string(channel::reference_m)].push_back(stroke_m * std::sin(turned_rad));
  }
  return recording;
}

double farthest_off_m_per_s(const Setpoints& setpoints, const SetpointSource& source) {
  const Setpoint& setpoint = setpoints.by(source.of_motion);
  double farthest = 0.0;
  for (int k = 20; k < 980; ++k)
    farthest = std::max(farthest, std::abs(setpoint.m_per_s(static_cast<std::size_t>(k), source.lead_s) - told_m_per_s(k)));
  return farthest;
}

TEST(Setpoint, IsTheMotionAheadByALead) {
  const Setpoints setpoints = setpoints_of(behind(false), count_m);
  EXPECT_GT(farthest_off_m_per_s(setpoints, {}), 0.015);
  EXPECT_LT(farthest_off_m_per_s(setpoints, {.lead_s = lag_s}), 5e-4);  // a count is 38 um/s, and 7.6 mm/s^2 of the slope
}

TEST(Setpoint, IsTheRecordedReferencesUnlessTheMotionIsToTell) {
  const Setpoints setpoints = setpoints_of(behind(true), count_m);
  EXPECT_LT(farthest_off_m_per_s(setpoints, {}), 2e-6);
  EXPECT_GT(farthest_off_m_per_s(setpoints, {.of_motion = true}), 0.015);
  EXPECT_LT(farthest_off_m_per_s(setpoints, {.lead_s = lag_s, .of_motion = true}), 5e-4);
}

TEST(Setpoint, TheSourceIsTheCompensations) {
  auto axis = plant::source_axis();
  EXPECT_EQ(setpoint_source(axis).lead_s, 0.0);
  axis.effects = {tests::effect("cogging", {}),
                  tests::effect("hidden_friction_compensation", {{"lead_s", 0.017}, {"of_motion", 1.0}})};
  EXPECT_EQ(setpoint_source(axis).lead_s, 0.017);
  EXPECT_TRUE(setpoint_source(axis).of_motion);
}

}  // namespace
}  // namespace feedtwin::tools

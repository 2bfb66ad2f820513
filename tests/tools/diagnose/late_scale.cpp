// A scale that is read late is told by the speed alone, and brought forward.

#include "tools/diagnose/late_scale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/made_case.h"
#include "tools/diagnose/setup_checks.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;
namespace channel = tools::channel;

std::vector<tools::Recording> runs_of(std::initializer_list<plant::EffectSetting> effects) {
  auto truth = plant::source_axis();
  truth.effects = effects;
  std::vector<tools::Recording> all;
  for (const char* motion : {"sine", "s_curve"})
    all.push_back(tests::make_recording(truth, {.motion = motion, .duration_s = 4.0, .scale_at_table = true}));
  return all;
}

plant::EffectSetting late(double delay_s) {
  return tests::effect("channel_skew", {{"scale_delay_s", delay_s}});
}

TEST(LateScale, IsToldWithItsDelayAndBroughtForward) {
  for (const double delay_s : {1.7e-3, 4e-3, 0.012}) {
    auto runs = runs_of({late(delay_s)});
    const auto found = late_scale(runs);
    ASSERT_TRUE(found.has_value()) << delay_s;
    EXPECT_NEAR(found->delay_s, delay_s, 2e-5);
    bring_forward(runs.front(), *found);
    const auto x = runs.front().at(channel::position_m), scale = runs.front().at(channel::scale_position_m);
    ASSERT_EQ(x.size(), scale.size());
    double largest_m = 0.0;
    for (std::size_t k = 20; k < x.size(); ++k) largest_m = std::max(largest_m, std::abs(scale[k] - x[k]));
    EXPECT_LT(largest_m, 3e-6) << delay_s;  // of 0.1 mm and more
  }
}

TEST(LateScale, WhatForceDirectionAndPlaceDoIsNoDelay) {
  const plant::EffectSetting none[] = {
      tests::effect("screw_compliance", {{"stiffness_N_per_m", 8e6}}),
      tests::effect("backlash", {{"gap_m", 2e-5}}),
      tests::effect("lead_error", {{"relative_error", 5e-3}}),
      tests::effect("cyclic_lead_error", {{"amplitude_m", 1e-5}, {"cycles_per_rev", 1.0}}),
      late(9e-4),  // how scales are read
  };
  for (const auto& effect : none) EXPECT_FALSE(late_scale(runs_of({effect})).has_value()) << effect.id;
}

TEST(LateScale, IsAFaultOfTheSetUpThatTheAxisThenShows) {
  tools::Case data;
  data.axis = plant::source_axis();
  data.fit = runs_of({late(4e-3)});
  const auto faults = mend_setup(data);
  const auto skew = std::ranges::find(faults, "channel_skew", &SetupFault::id);
  ASSERT_NE(skew, faults.end());
  EXPECT_EQ(skew->channel, "scale_position_m");
  EXPECT_FALSE(late_scale(data.fit).has_value());
  show_mended(data.axis, faults);
  ASSERT_EQ(data.axis.effects.size(), 1U);
  EXPECT_EQ(data.axis.effects[0].id, "channel_skew");
  EXPECT_NEAR(data.axis.effects[0].values[0], 4e-3, 2e-5);
}

}  // namespace
}  // namespace feedtwin

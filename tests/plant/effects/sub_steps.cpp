// What asks for sub-steps while the axis slides, and what does not: by a tick's own resolution an axis with the effect stays
// beside one that takes many.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "plant/effects/registry.h"
#include "plant/feed_axis.h"
#include "plant/parameter_table.h"
#include "tests/support/tick.h"
#include "tests/support/typical_effects.h"

namespace feedtwin::plant {
namespace {

using test::count_m;
using test::tick_s;

/// Moves the source's axis to and fro over some revolutions, against its friction.
double swept_Nm(int tick) {
  return 0.45 * std::sin(0.021 * tick) + 0.05 * std::sin(0.4 * tick + 1.0) + (tick % 97 < 10 ? 0.08 : 0.0);
}

/// Largest distance of an axis at its own resolution from one with so many sub-steps, in counts.
double counts_off(const std::vector<EffectSetting>& effects, Resolution own) {
  AxisParameters p = source_axis();
  p.effects = effects;
  FeedAxis axis(p, own), fine(p, {.sliding = 24, .settling = 24, .reversing = 24});
  double worst_m = 0.0;
  for (int i = 0; i < 900; ++i) {
    axis.step({swept_Nm(i)}, tick_s);
    fine.step({swept_Nm(i)}, tick_s);
    worst_m = std::max(worst_m, std::abs(axis.state().position_m - fine.state().position_m));
  }
  return worst_m / count_m;
}

constexpr Resolution three_while_sliding{.sliding = 3, .settling = 3, .reversing = 6};

TEST(SubSteps, WhatIsEvenInMotionTakesNoneAndNeedsNone) {
  int even = 0;
  for (const auto& entry : effect_registry()) {
    if (!entry.even_in_motion) continue;
    const std::vector effects{test::typical_effect(entry)};
    EXPECT_LT(counts_off(effects, one_count), 2.0) << entry.id << "; of an axis without effects 1.2";
    EXPECT_NE(counts_off(effects, one_count), counts_off(effects, three_while_sliding)) << entry.id;
    ++even;
  }
  EXPECT_GT(even, 5);
}

TEST(SubSteps, FrictionByTheLoadTakesThemBesideAWeightThatTakesNone) {
  const std::vector effects{test::typical_effect(*find_effect("gravity")),
                            test::typical_effect(*find_effect("load_dependent_friction"))};
  EXPECT_EQ(counts_off(effects, one_count), counts_off(effects, three_while_sliding));
}

}  // namespace
}  // namespace feedtwin::plant

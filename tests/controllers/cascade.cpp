#include "controllers/cascade.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "controllers/motion.h"
#include "plant/feed_axis.h"
#include "plant/parameter_table.h"

namespace feedtwin::controllers {
namespace {

constexpr double tick_s = 1e-3;

TEST(Cascade, NeverAsksForMoreThanTheLimit) {
  std::mt19937_64 random(61);
  std::uniform_real_distribution<double> wild(-1.0, 1.0);
  Cascade cascade({});
  for (int i = 0; i < 100000; ++i) {
    const double torque = cascade.torque_Nm({wild(random), 10.0 * wild(random), 1e3 * wild(random)}, wild(random), tick_s);
    ASSERT_LE(std::abs(torque), 1.9);
  }
}

// Held against a wall for ten seconds, then let go of: without anti-windup the integral would push on for as long again.
TEST(Cascade, DoesNotWindUp) {
  Cascade cascade({});
  cascade.reset(0.0);
  for (int i = 0; i < 10000; ++i) EXPECT_GE(cascade.torque_Nm({0.05, 0.0, 0.0}, 0.0, tick_s), 0.0);
  int still_pushing = 0;
  for (int i = 0; i < 1000; ++i) still_pushing += cascade.torque_Nm({-0.001, 0.0, 0.0}, 0.0, tick_s) > 0.0;
  EXPECT_LT(still_pushing, 200);
}

TEST(Cascade, RecoversFromSaturationWithoutLargeOvershoot) {
  plant::FeedAxis axis(plant::source_axis());
  Cascade cascade({});
  cascade.reset(0.0);
  double furthest_m = 0.0;
  for (int i = 0; i < 3000; ++i) {  // a step of 40 mm: the torque saturates at once
    const double torque =
        cascade.torque_Nm({0.04, 0.0, 0.0}, axis.encoder().position_m(axis.signals().encoder_counts), tick_s);
    axis.step({.torque_Nm = torque}, tick_s);
    furthest_m = std::max(furthest_m, axis.signals().position_m);
  }
  EXPECT_NEAR(axis.signals().position_m, 0.04, 2e-6);
  EXPECT_LT(furthest_m, 0.046);
}

TEST(Cascade, FollowsEveryMotion) {
  for (const auto& kind : motion_kinds()) {
    if (kind.of_recording) continue;  // what was recorded has limits of its own
    plant::FeedAxis axis(plant::source_axis());
    Cascade cascade({});
    cascade.reset(0.0);
    const auto motion = kind.make({});
    double worst_m = 0.0;
    for (int i = 0; i < 5000; ++i) {
      const Reference r = motion->at(i * tick_s);
      const double torque = cascade.torque_Nm(r, axis.encoder().position_m(axis.signals().encoder_counts), tick_s);
      worst_m = std::max(worst_m, std::abs(r.position_m - axis.signals().position_m));
      axis.step({.torque_Nm = torque}, tick_s);
    }
    EXPECT_LT(worst_m, 3e-4) << kind.name;
    EXPECT_GT(worst_m, 0.0) << kind.name;
  }
}

}  // namespace
}  // namespace feedtwin::controllers

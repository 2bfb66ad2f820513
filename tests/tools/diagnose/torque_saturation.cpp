// Where a limit of the torque is looked for.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/made_case.h"
#include "tools/diagnose/hypothesis.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

// However large the axis is, and however little of its command is cut off.
TEST(TorqueSaturation, IsLookedForUpToTheLargestCommand) {
  const auto axis = plant::source_axis();
  auto runs = make_tracks({tests::make_recording(axis, {.motion = "sine", .duration_s = 2.0})}, axis);
  for (const double times : {1.0, 400.0}) {
    for (auto& run : runs) run.held_N *= times;
    const double largest_N = runs.front().held_N.cwiseAbs().maxCoeff();
    const auto limits = hypothesis("torque_saturation").shapes_for(runs);
    for (const double share : {0.96, 0.8, 0.3, 0.05}) {
      const auto near = [&](const auto& limit) {
        return limit[0] < largest_N && std::abs(limit[0] / (share * largest_N) - 1.0) < 0.06;
      };
      EXPECT_TRUE(std::ranges::any_of(limits, near)) << share << " of " << largest_N;
    }
  }
}

// With all but a newton of its torque cut off a residual may look like anything; an axis would stand still.
TEST(TorqueSaturation, IsNoLimitThatTheFrictionWouldHold) {
  const auto& limit = hypothesis("torque_saturation");
  auto axis = plant::source_axis();
  const double friction_N = 0.5 * (axis.motor.coulomb_N.pos + axis.motor.coulomb_N.neg + axis.ball_screw.coulomb_N.pos +
                                   axis.ball_screw.coulomb_N.neg + axis.guide.coulomb_N.pos + axis.guide.coulomb_N.neg);
  EXPECT_FALSE(possible({&limit, {1.0, 1.0}}, axis));
  EXPECT_FALSE(possible({&limit, {1.0, 0.4 * friction_N}}, axis));
  EXPECT_TRUE(possible({&limit, {1.0, 0.8 * friction_N}}, axis)) << "the friction's numbers may be wrong";
  EXPECT_FALSE(possible({&limit, {0.3, 2.0 * friction_N}}, axis)) << "a third of what is beyond";
}

}  // namespace
}  // namespace feedtwin

// Friction that lags behind the velocity, sign and all, against an independent integrator.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "plant/feed_axis.h"
#include "tests/support/smooth_axis.h"

namespace feedtwin::plant {
namespace {

using test::rad_per_m;

constexpr double tick_s = 1e-3, lag_s = 8e-3;

/// Largest distance of a lagging axis from a body whose screw drags by its film, forth and back.
/// @param reversing amplitude of the torque beside its mean
double worst_m(const char* law, double mean_Nm, double reversing_Nm) {
  AxisParameters p = test::smooth_axis();
  p.effects = {{law, {lag_s}, {}}};
  FeedAxis axis(p);
  test::ReferenceBody body;
  const auto command_Nm = [&](int i) { return mean_Nm + reversing_Nm * std::sin(0.05 * i); };
  double film = 0.0, last_t = 0.0, worst = 0.0;
  for (int i = 0; i < 400; ++i) {
    axis.step({command_Nm(i)}, tick_s);
    body.run(
        tick_s, [&](double) { return rad_per_m * command_Nm(i); },
        [&](double t, double, double v) {
          film += (v - film) * (t - last_t) / lag_s;
          last_t = t;
          return 400.0 * (film - v);
        });
    worst = std::max(worst, std::abs(axis.state().position_m - body.x));
  }
  return worst;
}

TEST(FrictionalLag, OfVelocityGoesThroughZeroAtAReversal) {
  EXPECT_LT(worst_m("frictional_lag_of_velocity", 0.0, 0.25), 1e-6);
  EXPECT_GT(worst_m("frictional_lag", 0.0, 0.25), 2e-5) << "which lags behind speed, on the guide too";
}

}  // namespace
}  // namespace feedtwin::plant

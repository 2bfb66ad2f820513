// Friction that lags behind speed, or behind velocity, sign and all, against an independent integrator.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "plant/feed_axis.h"
#include "tests/support/smooth_axis.h"
#include "tests/support/tick.h"

namespace feedtwin::plant {
namespace {

using test::rad_per_m;
using test::tick_s;

constexpr double lag_s = 8e-3;

/// What a body drags by beyond the axis's own friction, and what its film follows.
struct Lagging {
  std::function<double(double v)> followed;
  std::function<double(double film, double v)> more_N;
};

const Lagging behind_speed{[](double v) { return std::abs(v); },
                           [](double film, double v) { return 800.0 * (film - std::abs(v)) * v / (std::abs(v) + 1e-4); }};
const Lagging behind_velocity{[](double v) { return v; }, [](double film, double v) { return 400.0 * (film - v); }};

double forth_Nm(int i) {
  return 0.06 + 0.04 * std::sin(0.2 * i) + (i % 50 < 10 ? 0.05 : 0.0);
}
double forth_and_back_Nm(int i) {
  return 0.25 * std::sin(0.05 * i);
}

struct Compared {
  double worst_m = 0.0, way_m = 0.0;
};
Compared compared(const char* law, const Lagging& truth, double (*command_Nm)(int)) {
  AxisParameters p = test::smooth_axis();
  p.effects = {{law, {lag_s}, {}}};
  FeedAxis axis(p);
  test::ReferenceBody body;
  Compared found;
  double film = 0.0, last_t = 0.0;
  for (int i = 0; i < 400; ++i) {
    axis.step({command_Nm(i)}, tick_s);
    body.run(
        tick_s, [&](double) { return rad_per_m * command_Nm(i); },
        [&](double t, double, double v) {
          film += (truth.followed(v) - film) * (t - last_t) / lag_s;
          last_t = t;
          return truth.more_N(film, v);
        });
    found.worst_m = std::max(found.worst_m, std::abs(axis.state().position_m - body.x));
    found.way_m = std::max(found.way_m, std::abs(body.x));
  }
  return found;
}

TEST(FrictionalLag, IsBehindSpeed) {
  const Compared found = compared("frictional_lag", behind_speed, forth_Nm);
  EXPECT_LT(found.worst_m, 1e-6);
  EXPECT_GT(found.way_m, 0.02);
}

TEST(FrictionalLag, OfVelocityGoesThroughZeroAtAReversal) {
  EXPECT_LT(compared("frictional_lag_of_velocity", behind_velocity, forth_and_back_Nm).worst_m, 1e-6);
  EXPECT_GT(compared("frictional_lag", behind_velocity, forth_and_back_Nm).worst_m, 2e-5)
      << "which lags behind speed, on the guide too";
}

}  // namespace
}  // namespace feedtwin::plant

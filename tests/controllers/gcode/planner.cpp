#include "controllers/gcode/planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "controllers/gcode/interpreter.h"
#include "tests/support/random_program.h"

namespace feedtwin::controllers::gcode {
namespace {

PlannerSettings settings_with(double speed, double acceleration, double jerk) {
  PlannerSettings s;
  s.limits.speed_m_per_s = {speed, 0.8 * speed, 0.5 * speed};
  s.limits.acceleration_m_per_s2 = {acceleration, 1.3 * acceleration, 0.7 * acceleration};
  s.limits.jerk_m_per_s3 = {jerk, 0.6 * jerk, 1.5 * jerk};
  return s;
}

/// Velocity, acceleration and jerk by divided differences of positions alone: means of the derivatives, so bounded by them.
void expect_within_limits(const Trajectory& trajectory, double time_s, double h_s, const AxisLimits& limits) {
  Trajectory::Cursor cursor;
  Point p[4];
  for (int k = 0; k < 4; ++k) p[k] = trajectory.at(time_s + k * h_s, cursor).at_m;
  for (int axis = 0; axis < 3; ++axis) {
    const double v = (p[1][axis] - p[0][axis]) / h_s;
    const double a = (p[2][axis] - 2 * p[1][axis] + p[0][axis]) / (h_s * h_s);
    const double j = (p[3][axis] - 3 * p[2][axis] + 3 * p[1][axis] - p[0][axis]) / (h_s * h_s * h_s);
    const double rounding = 1e-16 + 3e-16 * std::abs(time_s) * limits.speed_m_per_s[axis];  // of position and of time
    ASSERT_LE(std::abs(v), limits.speed_m_per_s[axis] * (1 + 1e-9) + rounding / h_s) << "axis " << axis << " at " << time_s;
    ASSERT_LE(std::abs(a), limits.acceleration_m_per_s2[axis] * (1 + 1e-9) + 4 * rounding / (h_s * h_s))
        << "axis " << axis << " at " << time_s;
    ASSERT_LE(std::abs(j), limits.jerk_m_per_s3[axis] * (1 + 1e-9) + 8 * rounding / (h_s * h_s * h_s))
        << "axis " << axis << " at " << time_s;
  }
}

/// Distance of a point from one programmed move, by its own geometry.
double distance_m(const Segment& s, const Point& p) {
  if (!s.is_arc()) {
    const Point along = s.to_m() - s.from_m();
    const double t = std::clamp(dot(p - s.from_m(), along) / dot(along, along), 0.0, 1.0);
    return length(p - (s.from_m() + t * along));
  }
  double best = 1e9;  // a helix has no closed form: the nearest of many points, then of many about it
  double low = 0.0, high = s.length_m();
  for (int round = 0; round < 4; ++round) {
    double nearest = low;
    const double step = (high - low) / 200;
    for (int i = 0; i <= 200; ++i) {
      const double d = length(s.at(low + i * step).at_m - p);
      if (d < best) {
        best = d;
        nearest = low + i * step;
      }
    }
    low = std::max(0.0, nearest - step);
    high = std::min(s.length_m(), nearest + step);
  }
  return best;
}

TEST(Planner, RandomProgramsStayWithinEveryLimit) {
  const unsigned programs = std::getenv("FEEDTWIN_ALL_TESTS") != nullptr ? 100000 : 1500;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::size_t segments = 0;
  for (unsigned seed = 0; seed < programs; ++seed) {
    const auto program = interpret(tests::random_program(seed, {.lines = 25, .all_codes = seed % 4 == 0}));
    const auto settings = settings_with(std::pow(10.0, -2 + 1.5 * uniform(random)), std::pow(10.0, -1 + 2 * uniform(random)),
                                        std::pow(10.0, 1 + 2.5 * uniform(random)));
    const auto trajectory = plan(program, settings);
    segments += trajectory.segments().size();
    for (int i = 0; i < 100; ++i) {
      const double h_s = std::pow(10.0, -4 + uniform(random));
      expect_within_limits(trajectory, uniform(random) * trajectory.duration_s() - 2 * h_s, h_s, settings.limits);
      ASSERT_FALSE(testing::Test::HasFatalFailure())
          << "seed " << seed << "\n"
          << tests::random_program(seed, {.lines = 25, .all_codes = seed % 4 == 0});
    }
  }
  std::printf("%u programs, %zu moves\n", programs, segments);
}

TEST(Planner, EveryTickOfAFewProgramsStaysWithinEveryLimit) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    const auto settings = settings_with(0.1, 1.0, 50.0);
    const auto trajectory = plan(interpret(tests::random_program(seed, {.lines = 12, .all_codes = false})), settings);
    for (double t = -2e-3; t < std::min(trajectory.duration_s(), 60.0); t += 1e-3) {
      expect_within_limits(trajectory, t, 1e-3, settings.limits);
      ASSERT_FALSE(testing::Test::HasFatalFailure()) << "seed " << seed;
    }
  }
}

TEST(Planner, TheReferenceRunsWithinToleranceOfThePathAndReachesItsEnd) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (unsigned seed = 0; seed < 60; ++seed) {
    const double tolerance_m = std::pow(10.0, -6 + 3 * uniform(random));
    auto program = interpret(tests::random_program(seed, {.lines = 12, .all_codes = false}));
    for (auto& command : program) {
      if (auto* mode = std::get_if<SetPathMode>(&command.action)) *mode = {PathMode::continuous, tolerance_m};
    }
    const auto trajectory = plan(program, settings_with(0.1, 2.0, 100.0));
    EXPECT_LE(trajectory.largest_blend_deviation_m(), tolerance_m);
    for (int i = 0; i < 60; ++i) {
      Trajectory::Cursor cursor;
      const auto setpoint = trajectory.at(uniform(random) * trajectory.duration_s(), cursor);
      double nearest = 1e9;
      for (const auto& segment : trajectory.segments()) nearest = std::min(nearest, distance_m(segment, setpoint.at_m));
      ASSERT_LE(nearest, tolerance_m * (1 + 1e-6) + 1e-9) << "seed " << seed;
      // and the place on the path that it names is near
      const Point named = trajectory.segments()[setpoint.segment].at(setpoint.along_m).at_m;
      ASSERT_LE(length(named - setpoint.at_m), tolerance_m * 1.01 + 1e-9) << "seed " << seed;
    }
    Trajectory::Cursor cursor;
    const auto end = trajectory.at(trajectory.duration_s() + 1.0, cursor);
    ASSERT_LE(length(end.at_m - trajectory.segments().back().to_m()), 1e-12);
    ASSERT_EQ(length(end.velocity_m_per_s), 0.0);
  }
}

TEST(Planner, ItsVelocityAndAccelerationAreThoseOfItsPositions) {
  const auto trajectory =
      plan(interpret(tests::random_program(3, {.lines = 20, .all_codes = false})), settings_with(0.1, 2, 100));
  const double h = 1e-5;
  for (double t = 0.0; t < trajectory.duration_s(); t += 7.3e-3) {
    Trajectory::Cursor cursor;
    const auto before = trajectory.at(t - h, cursor), now = trajectory.at(t, cursor), after = trajectory.at(t + h, cursor);
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_NEAR((after.at_m[axis] - before.at_m[axis]) / (2 * h), now.velocity_m_per_s[axis], 2e-8);
      ASSERT_NEAR((after.velocity_m_per_s[axis] - before.velocity_m_per_s[axis]) / (2 * h), now.acceleration_m_per_s2[axis],
                  4e-3);
    }
  }
}

double duration_s(const char* text, double tolerance_m = 5e-6) {
  auto settings = settings_with(0.1, 2.0, 100.0);
  settings.blend_tolerance_m = tolerance_m;
  return plan(interpret(text), settings).duration_s();
}

TEST(Planner, ALongMoveTakesItsLengthAtTheFeedAndARampAtEitherEnd) {
  // x: 2 m/s^2, 100 m/s^3; up to 10 mm/s in 2 sqrt(v / j) = 20 ms, half of which is lost at either end
  EXPECT_NEAR(duration_s("G1 X100 F600\nM2"), 10.0 + 0.02, 1e-9);
}

TEST(Planner, CollinearMovesDoNotStopEvenOnTheExactPath) {
  EXPECT_NEAR(duration_s("G61 G1 X50 F600\nX100\nM2"), duration_s("G61 G1 X100 F600\nM2"), 1e-9);
  EXPECT_GT(duration_s("G61.1 G1 X50 F600\nX100\nM2"), duration_s("G61 G1 X100 F600\nM2") + 0.015);
}

TEST(Planner, ShortMovesAlongACircleAreAsFastAsTheArc) {
  std::string text = "G64 P0.01 G1 F300\n";
  for (int i = 1; i <= 200; ++i) {
    const double angle = i * 0.01 * 3.14159265358979;
    text += "X" + std::to_string(10 - 10 * std::cos(angle)) + " Y" + std::to_string(10 * std::sin(angle)) + "\n";
  }
  text += "M2";
  const double arc_s = duration_s("G2 I10 F300\nM2");
  EXPECT_NEAR(duration_s(text.c_str()), arc_s, 0.05 * arc_s);
}

TEST(Planner, AWiderToleranceIsFaster) {
  const char* zigzag = "G1 F6000\nX1 Y1\nX2 Y0\nX3 Y1\nX4 Y0\nX5 Y1\nM2";
  double last = 1e9;
  for (const double tolerance_m : {1e-9, 1e-6, 1e-5, 1e-4, 1e-3}) {
    const double now = duration_s(zigzag, tolerance_m);
    EXPECT_LE(now, last) << tolerance_m;
    last = now;
  }
  EXPECT_LT(last, 0.9 * duration_s(zigzag, 1e-9));
}

TEST(Planner, SwitchingCommandsStopTheAxesAndDwellsLast) {
  auto settings = settings_with(0.1, 2.0, 100.0);
  const auto trajectory = plan(interpret("G1 X10 F600\nM8\nG1 X20\nG4 P0.5\nX30\nM2"), settings);
  ASSERT_GE(trajectory.events().size(), 2U);
  Trajectory::Cursor cursor;
  for (const auto& event : trajectory.events()) {
    EXPECT_EQ(length(trajectory.at(event.time_s, cursor).velocity_m_per_s), 0.0) << event.line;
  }
  EXPECT_NEAR(trajectory.duration_s(), 3 * (1.0 + 0.02) + 0.5, 1e-9);
}

TEST(Planner, TheFeedOverrideScalesFeedsOnly) {
  auto settings = settings_with(0.1, 2.0, 100.0);
  settings.feed_override = 2.0;
  EXPECT_NEAR(plan(interpret("G1 X100 F600\nM2"), settings).duration_s(), 5.0 + 2 * std::sqrt(0.02 / 100), 1e-9);
  EXPECT_NEAR(plan(interpret("G0 X100\nM2"), settings).duration_s(), duration_s("G0 X100\nM2"), 1e-12);
}

}  // namespace
}  // namespace feedtwin::controllers::gcode

// The motor's Coulomb friction along a recorded motion, at once and over a path.

#include "tools/diagnose/motor_friction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/made_case.h"
#include "tools/diagnose/inverse_model.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

plant::AxisParameters axis_over(double distance_m) {
  auto axis = plant::source_axis();
  axis.effects = {tests::effect("motor_presliding", {{"distance_m", distance_m}})};
  return axis;
}

tools::Recording turning(const plant::AxisParameters& truth) {
  tests::MadeRun run{.duration_s = 3.0, .torque_noise_Nm = 5e-4, .force_noise_N = 0.05};
  run.settings = {.amplitude_m = 0.01, .speed_m_per_s = 0.06};
  return tests::make_recording(truth, run);
}

/// RMS of what the motor's own equation leaves over within 20 ms after a reversal, N.
double left_after_reversals_N(const InverseModel& model, const plant::AxisParameters& axis) {
  const Vector residual = model.residual(axis, {});
  double sum = 0.0;
  Index rows = 0;
  for (const Segment& segment : model.segments()) {
    if (!model.equations()[segment.equation].motor) continue;
    const Track& track = model.tracks()[segment.run];
    for (Index row = segment.start; row < segment.start + segment.size; ++row) {
      const Index k = model.sample_of(segment, row);
      if (k < 500 || track.since_reversal_s[k] > 0.02) continue;
      sum += residual[row] * residual[row], ++rows;
    }
  }
  return std::sqrt(sum / static_cast<double>(rows));
}

// A motor that sets in over micrometres: the model that has the path leaves a fraction of what one without leaves.
TEST(MotorFriction, TheModelThatHasThePathFollowsIt) {
  for (const double distance_m : {1e-6, 5e-6, 2e-5}) {
    const auto truth = axis_over(distance_m);
    const InverseModel model(make_tracks({turning(truth)}, truth), truth);
    const double with_N = left_after_reversals_N(model, truth);
    const double at_once_N = left_after_reversals_N(model, plant::source_axis());
    EXPECT_LT(with_N, 0.4 * at_once_N) << distance_m << " m";
  }
}

// Far from a reversal both are Coulomb's.
TEST(MotorFriction, AllOfItOnceThePathIsGone) {
  const auto truth = axis_over(1e-6);
  const Track track = make_track(turning(truth), truth);
  const Vector over_path_N = motor_coulomb_N(track, truth), at_once_N = motor_coulomb_N(track, plant::source_axis());
  Index slid = 0;
  for (Index k = 500; k < track.size; ++k) {
    if (track.since_reversal_s[k] < 0.05 || std::abs(track.velocity_m_per_s[k]) < 0.01) continue;
    EXPECT_NEAR(over_path_N[k], at_once_N[k], 1e-3) << k;
    ++slid;
  }
  EXPECT_GT(slid, 1000);
}

TEST(MotorFriction, NoPathIsAtOnce) {
  const Track track = make_track(turning(plant::source_axis()), plant::source_axis());
  EXPECT_EQ(motor_presliding_m(plant::source_axis()), 0.0);
  EXPECT_EQ(motor_coulomb_N(track, axis_over(0.0)), motor_coulomb_N(track, plant::source_axis()));
}

}  // namespace
}  // namespace feedtwin

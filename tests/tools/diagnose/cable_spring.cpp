// Where a cable hangs at rest the command alone hardly tells: a constant force moves that point, and Coulomb friction that
// is off by direction is one.

#include <gtest/gtest.h>

#include "tests/support/made_case.h"
#include "tests/support/testbed.h"
#include "tests/tools/diagnose/fitted_runs.h"
#include "tools/diagnose/judge.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

/// Runs of a machine with a soft cable, and the numbers of an axis file whose friction is off by direction.
struct SoftCable : testing::Test {
  static constexpr double stiffness_N_per_m = 19.0, neutral_m = 0.018, off_N = 12.0;

  static std::vector<tools::Recording> recorded() {
    auto truth = plant::source_axis();
    truth.effects.push_back(
        tests::effect("cable_spring", {{"stiffness_N_per_m", stiffness_N_per_m}, {"neutral_m", neutral_m}}));
    std::vector<tools::Recording> runs;
    for (const char* motion : {"sine", "s_curve"}) {
      tests::MadeRun made{.motion = motion, .duration_s = 6.0, .sensors = false};
      made.settings.speed_m_per_s = 0.08, made.settings.amplitude_m = 0.03;
      runs.push_back(tests::make_recording(truth, made));
    }
    return runs;
  }

  static plant::AxisParameters off_by_direction() {
    auto axis = plant::source_axis();
    for (auto* friction_N : {&axis.ball_screw.coulomb_N, &axis.ball_screw.static_N})
      friction_N->pos -= off_N, friction_N->neg += off_N;
    return axis;
  }

  [[nodiscard]] Fit with_cable() const {
    const Candidate model{fitted_.fit.model.axis, {{&hypothesis("cable_spring"), {0.0, 0.0}}}};
    return fitted_.fitter.fit(model, fitted_.whitening, refit_iterations);
  }

  tests::FittedRuns fitted_{recorded(), off_by_direction()};
};

TEST_F(SoftCable, HangsAtRestAlongTheTravel) {
  const Fit with = with_cable();
  const Active& cable = with.model.effects.front();
  const auto values = cable.hypothesis->named(cable.q, with.model.axis);
  EXPECT_NEAR(values[0].value, stiffness_N_per_m, 0.05 * stiffness_N_per_m);
  EXPECT_LT(std::abs(values[1].value - with.model.axis.axis.stroke_centre_m), with.model.axis.axis.stroke_m)
      << "m: " << values[1].value;
  EXPECT_TRUE(possible(cable, with.model.axis));
}

TEST_F(SoftCable, WhereItMayHangIsNoNumberOfTheFile) {
  const Fit with = with_cable();
  EXPECT_EQ(with.white.size(), fitted_.model.rows() + with.base_count() + 1);
  const Verdict told = judged(fitted_.fitter, with, fitted_.fit, hypothesis("cable_spring"), Bar{});
  const double nearer =
      fitted_.fitter.squared_tolerances(fitted_.fit.model.axis) - fitted_.fitter.squared_tolerances(with.model.axis);
  EXPECT_NEAR(told.surprise, nearer, 1e-9 * std::abs(nearer) + 1e-9);
}

TEST(CableSpring, IsLessLikelyTheFartherItsNeutralPointLies) {
  const auto axis = plant::source_axis();
  const auto unlikely = hypothesis("cable_spring").unlikely;
  const auto at = [&](double stiffness, double neutral_m) {
    const std::vector<double> q{stiffness, -stiffness * neutral_m};
    return unlikely(q, axis);
  };
  const double centre_m = axis.axis.stroke_centre_m, stroke_m = axis.axis.stroke_m;
  EXPECT_NEAR(at(50.0, centre_m), 0.0, 1e-12);
  EXPECT_NEAR(at(50.0, centre_m + 0.5 * stroke_m), 2.0, 1e-9);
  EXPECT_NEAR(at(50.0, centre_m - 0.5 * stroke_m), -2.0, 1e-9);
  EXPECT_DOUBLE_EQ(at(50.0, 0.1), at(5000.0, 0.1)) << "a point is as far off, however stiff the cable";
  EXPECT_TRUE(std::isfinite(at(0.0, 0.0)));
}

}  // namespace
}  // namespace feedtwin

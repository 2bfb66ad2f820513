// A tool that cuts both ways through a workpiece: its line turns with the motion, and is found with the place where it acts.

#include "tools/diagnose/workpiece.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/made_case.h"
#include "tests/tools/diagnose/fitted_runs.h"
#include "tools/diagnose/judge.h"
#include "tools/diagnose/reported.h"
#include "tools/diagnose/screen.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

constexpr double tooth_Hz = 34.4;

std::vector<tools::Recording> runs_with(double tooth_N, double from_m, double to_m, double only_direction = 0.0) {
  auto axis = plant::source_axis();
  axis.effects.push_back(tests::effect("process_force_against_motion", {{"opposing_N", 1.2 * tooth_N},
                                                                        {"amplitude_N", tooth_N},
                                                                        {"frequency_Hz", tooth_Hz},
                                                                        {"from_m", from_m},
                                                                        {"to_m", to_m},
                                                                        {"only_direction", only_direction}}));
  std::vector<tools::Recording> runs;
  for (const double speed_m_per_s : {0.03, 0.05})
    runs.push_back(tests::make_recording(
        axis, {.motion = "triangle", .settings = {.amplitude_m = 0.02, .speed_m_per_s = speed_m_per_s}, .duration_s = 8.0}));
  return runs;
}

const Score& score_of(const Screen& screened) {
  return *std::ranges::find(screened.scores, &hypothesis("process_force_against_motion"), &Score::hypothesis);
}

TEST(Workpiece, IsFoundWithItsPlaceAndTheForceInIt) {
  const auto nominal = plant::source_axis();
  const tests::FittedRuns made(runs_with(4.0, -0.005, 0.008), nominal);
  const auto place = place_of_line(made.model, turned(made.model, made.fit.white), tooth_Hz);
  ASSERT_TRUE(place.has_value());
  EXPECT_NEAR(place->from_m, -0.005, 1e-3);
  EXPECT_NEAR(place->to_m, 0.008, 1e-3);
  EXPECT_EQ(place->only_direction, 0.0);
  const auto screened = screen(made.fitter, made.fit, made.whitening);
  const Fit fit = fit_with(made.fitter, made.fit.model, score_of(screened), 0, made.whitening, 8);
  const Active& process = fit.model.effects.front();
  const auto named = process.hypothesis->named(process.q, nominal);
  EXPECT_NEAR(named[0].value, 4.8, 0.5);
  EXPECT_NEAR(named[1].value, 4.0, 0.3);
  EXPECT_NEAR(named[2].value, tooth_Hz, 0.02);
  EXPECT_EQ(told_id(*process.hypothesis), "process_force");
  Found found;
  found.effect = process;
  const auto told = named_effect(found, fit, robust_covariance(made.model, fit), made.model);
  for (const auto& [name, estimate] : told.parameters)
    EXPECT_LT(estimate.low, estimate.high) << name << ": with two runs of four too";
}

TEST(Workpiece, MayBeCutOneWayAlone) {
  for (const double only_direction : {1.0, -1.0}) {
    const tests::FittedRuns made(runs_with(4.0, -0.005, 0.008, only_direction), plant::source_axis());
    const auto place = place_of_line(made.model, turned(made.model, made.fit.white), tooth_Hz);
    ASSERT_TRUE(place.has_value());
    EXPECT_EQ(place->only_direction, only_direction);
    EXPECT_NEAR(place->from_m, -0.005, 1e-3);
    EXPECT_NEAR(place->to_m, 0.008, 1e-3);
    const auto screened = screen(made.fitter, made.fit, made.whitening);
    const Fit fit = fit_with(made.fitter, made.fit.model, score_of(screened), 0, made.whitening, 8);
    const Active& process = fit.model.effects.front();
    const auto named = process.hypothesis->named(process.q, plant::source_axis());
    EXPECT_NEAR(named[0].value, 4.8, 1.0) << "friction by direction takes some of it";
    EXPECT_NEAR(named[1].value, 4.0, 0.6);
    EXPECT_EQ(named.back().name, "only_direction");
    EXPECT_EQ(named.back().value, only_direction);
    Found found;
    found.effect = process;
    const auto told = named_effect(found, fit, robust_covariance(made.model, fit), made.model);
    const std::string way = only_direction > 0.0 ? "in positive direction" : "in negative direction";
    EXPECT_NE(told.sentence.find(way), std::string::npos) << told.sentence;
  }
}

TEST(Workpiece, AlongTheWholeTravelIsNoPlace) {
  const tests::FittedRuns made(runs_with(4.0, -1.0, 1.0), plant::source_axis());
  EXPECT_FALSE(place_of_line(made.model, turned(made.model, made.fit.white), tooth_Hz).has_value());
}

// The line of a motor that runs all the time keeps its sign: turned, it falls apart.
TEST(Workpiece, AFloorsLineDoesNotTurn) {
  auto axis = plant::source_axis();
  axis.effects.push_back(tests::effect("floor_vibration", {{"acceleration_m_per_s2", 0.5}, {"frequency_Hz", tooth_Hz}}));
  std::vector<tools::Recording> runs;
  for (const char* motion : {"sine", "triangle"})
    runs.push_back(tests::make_recording(axis, {.motion = motion, .duration_s = 8.0}));
  const tests::FittedRuns made(runs, plant::source_axis());
  const auto screened = screen(made.fitter, made.fit, made.whitening);
  const auto floor = std::ranges::find(screened.scores, &hypothesis("floor_vibration"), &Score::hypothesis);
  EXPECT_LT(score_of(screened).gain, 0.5 * floor->gain);
}

}  // namespace
}  // namespace feedtwin

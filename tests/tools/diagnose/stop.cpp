// What struck is found where it stands, though the blow lies between that place and where the fit looked first.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/made_case.h"
#include "tests/tools/diagnose/fitted_runs.h"
#include "tools/diagnose/screen.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

constexpr double stiffness_N_per_m = 2e5, damping_Ns_per_m = 1e4, stands_m = 0.0188;

std::vector<tools::Recording> runs_against_it() {
  auto axis = plant::source_axis();
  axis.effects.push_back(tests::effect("hard_stop", {{"stiffness_N_per_m", stiffness_N_per_m},
                                                     {"damping_Ns_per_m", damping_Ns_per_m},
                                                     {"position_m", stands_m},
                                                     {"direction", 1.0}}));
  std::vector<tools::Recording> runs;
  for (const double speed_m_per_s : {0.02, 0.04})
    runs.push_back(tests::make_recording(
        axis, {.motion = "triangle", .settings = {.amplitude_m = 0.02, .speed_m_per_s = speed_m_per_s}, .duration_s = 6.0}));
  return runs;
}

TEST(HardStop, IsFoundFromPlacesBesideIt) {
  const tests::FittedRuns made(runs_against_it(), plant::source_axis());
  const auto& stop = hypothesis("hard_stop");
  Score score;
  score.hypothesis = &stop;
  for (const double off_m : {-6e-4, -3e-4, 3e-4}) {
    score.q = {stiffness_N_per_m, damping_Ns_per_m, stands_m + off_m, 1.0};
    const Fit fit = fit_with(made.fitter, made.fit.model, score, 0, made.whitening, 6);
    EXPECT_NEAR(fit.model.effects.front().q[2], stands_m, 1.2e-4) << off_m;
  }
}

TEST(HardStop, OfWhichTheBlowAloneIsLeftIsTriedWithSomethingBehindIt) {
  const auto& stop = hypothesis("hard_stop");
  const auto starts = stop.starts_after(std::vector{0.0, 1.8e4, 0.05, 1.0});
  ASSERT_FALSE(starts.empty());
  for (const auto& q : starts) {
    EXPECT_TRUE(possible({&stop, q}, plant::source_axis()));
    EXPECT_GT(q[0], 1e4);
    EXPECT_NEAR(q[2], 0.05, 1e-3);
  }
  const auto beside = stop.starts_after(std::vector{3e5, 5e3, 0.05, -1.0});
  for (const auto& q : beside) EXPECT_EQ(q[0], 3e5) << "what yields yields there too";
}

}  // namespace
}  // namespace feedtwin

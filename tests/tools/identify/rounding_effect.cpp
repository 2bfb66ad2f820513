#include "tools/identify/rounding_effect.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/made_case.h"
#include "tools/identify/axis_unknowns.h"
#include "tools/identify/fit_covariance.h"

namespace feedtwin::tools {
namespace {

/// A slow run in pre-sliding, with the sensors' noise.
Recording hysteresis(const plant::AxisParameters& axis, double centre_m) {
  return tests::make_recording(axis, {.motion = "sine",
                                      .settings = {.centre_m = centre_m, .amplitude_m = 6e-5, .speed_m_per_s = 6e-3},
                                      .duration_s = 1.0,
                                      .torque_noise_Nm = 5e-4,
                                      .force_noise_N = 0.06,
                                      .resolution = plant::one_count});
}

struct Effect {
  std::vector<FitParameter> unknowns;
  Eigen::MatrixXd rounding;
};

/// At the true parameters, linearised there.
Effect effect_at(const plant::AxisParameters& axis, const Recording& recording, int grids,
                 const std::optional<controllers::CascadeGains>& controller = std::nullopt) {
  const std::vector recordings{recording};
  std::vector<ClosedLoopRun> runs;
  runs.emplace_back(recordings[0], axis, controller);
  Effect effect{axis_unknowns(axis, recordings), {}};
  const auto simulate = lane_simulator(axis, effect.unknowns);
  ResidualStack stack(runs, effect.unknowns, simulate, {});
  const auto n = static_cast<Eigen::Index>(effect.unknowns.size());
  LeastSquaresSolution at;
  at.point.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) at.point[i] = effect.unknowns[static_cast<std::size_t>(i)].nominal;
  stack.weigh(at.point, true);
  Eigen::MatrixXd points = at.point.replicate(1, n + 1);
  for (Eigen::Index i = 0; i < n; ++i) points(i, i + 1) += 1e-3 * effect.unknowns[static_cast<std::size_t>(i)].scale;
  const Eigen::MatrixXd residuals = stack(points);
  at.residuals = residuals.col(0);
  at.jacobian.resize(residuals.rows(), n);
  for (Eigen::Index i = 0; i < n; ++i)
    at.jacobian.col(i) =
        (residuals.col(i + 1) - residuals.col(0)) / (1e-3 * effect.unknowns[static_cast<std::size_t>(i)].scale);
  effect.rounding = rounding_effect(at, inverse_information(at), stack, grids);
  return effect;
}

double deviation_of(const Effect& effect, std::string_view key) {
  for (std::size_t i = 0; i < effect.unknowns.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (effect.unknowns[i].key == key) return std::sqrt(effect.rounding(at, at));
  }
  return std::nan("");
}

// With counts 16 times as fine, rests tell where the axis is; the tick in which it sets off stays as uncertain as it was.
TEST(RoundingEffect, ShrinksWithTheCount) {
  auto coarse = plant::source_axis(), fine = coarse;
  fine.axis.encoder_counts_per_rev *= 16.0;
  const auto with_coarse = effect_at(coarse, hysteresis(coarse, 1e-3), 24);
  const auto with_fine = effect_at(fine, hysteresis(fine, 1e-3), 24);
  double logarithms = 0.0, count = 0.0;
  for (const auto& unknown : with_fine.unknowns) {
    if (unknown.key.starts_with("nuisance.") || unknown.key.starts_with("motor.ke")) continue;
    EXPECT_GT(deviation_of(with_fine, unknown.key), 0.0) << unknown.key;
    logarithms += std::log(deviation_of(with_coarse, unknown.key) / deviation_of(with_fine, unknown.key));
    count += 1.0;
  }
  EXPECT_GT(std::exp(logarithms / count), 2.0) << "times, in the geometric mean of " << count;
}

TEST(RoundingEffect, IsTheSameEveryTime) {
  const auto axis = plant::source_axis();
  const auto recording = hysteresis(axis, 2e-3);
  const auto first = effect_at(axis, recording, 8), again = effect_at(axis, recording, 8);
  EXPECT_EQ(first.rounding, again.rounding);
}

TEST(RoundingEffect, IsNotSeenBehindAControllerOrWithoutGrids) {
  const auto axis = plant::source_axis();
  const auto recording = hysteresis(axis, 3e-3);
  EXPECT_EQ(effect_at(axis, recording, 1).rounding.norm(), 0.0);
  EXPECT_EQ(effect_at(axis, recording, 8, controllers::CascadeGains{}).rounding.norm(), 0.0);
}

}  // namespace
}  // namespace feedtwin::tools

// Slopes kept from one polish to the next: what is known is not simulated, and of a linear system nothing is lost by it.

#include "tools/diagnose/forward/slopes.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace feedtwin {
namespace {

using namespace tools::diagnosis;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Eigen::Index numbers = 3, unknowns = 5;

/// A run whose command is a linear map of the unknowns, and how many points it was asked for.
struct LinearRun {
  MatrixXd map;
  int asked = 0;

  std::vector<tools::Simulated> operator()(const MatrixXd& points) {
    std::vector<tools::Simulated> all;
    for (Eigen::Index p = 0; p < points.cols(); ++p) {
      const VectorXd torque = map * points.col(p);
      all.emplace_back().torque_Nm.assign(torque.begin(), torque.end());
      ++asked;
    }
    return all;
  }
};

MatrixXd forward_differences(const VectorXd& at, double step) {
  MatrixXd points = at.replicate(1, at.size() + 1);
  for (Eigen::Index i = 0; i < at.size(); ++i) points(i, i + 1) += step;
  return points;
}

class SlopesOfRandomRuns : public testing::TestWithParam<unsigned> {};

TEST_P(SlopesOfRandomRuns, OnlyTheEffectsOwnUnknownsAreSimulatedAgainAndTheResultIsTheSame) {
  srand(GetParam());
  LinearRun run{MatrixXd::Random(20, unknowns)};
  const auto simulate = [&run](const MatrixXd& points) { return run(points); };
  Slopes slopes(2, numbers);
  const MatrixXd first = forward_differences(VectorXd::Random(unknowns), 1e-3);
  slopes.learn(1, first, simulate(first));
  const MatrixXd later = forward_differences(VectorXd::Random(unknowns), -2e-3);
  const auto truth = simulate(later);
  run.asked = 0;
  const auto found = slopes.simulated(1, later, simulate);
  EXPECT_EQ(run.asked, 1 + unknowns - numbers);
  ASSERT_EQ(found.size(), truth.size());
  for (std::size_t p = 0; p < found.size(); ++p)
    for (std::size_t k = 0; k < truth[p].torque_Nm.size(); ++k)
      EXPECT_NEAR(found[p].torque_Nm[k], truth[p].torque_Nm[k], 1e-12) << p;
}

TEST_P(SlopesOfRandomRuns, WhatIsNoDifferenceOrOfAnotherRunIsSimulated) {
  srand(GetParam());
  LinearRun run{MatrixXd::Random(20, unknowns)};
  const auto simulate = [&run](const MatrixXd& points) { return run(points); };
  Slopes slopes(2, numbers);
  const MatrixXd differences = forward_differences(VectorXd::Random(unknowns), 1e-3);
  slopes.learn(1, differences, simulate(differences));
  for (const auto& [place, points] :
       {std::pair<std::size_t, MatrixXd>{0, differences}, {1, MatrixXd::Random(unknowns, unknowns + 1)}}) {
    run.asked = 0;
    EXPECT_EQ(slopes.simulated(place, points, simulate).size(), static_cast<std::size_t>(points.cols()));
    EXPECT_EQ(run.asked, points.cols());
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, SlopesOfRandomRuns, testing::Range(1U, 6U));

}  // namespace
}  // namespace feedtwin

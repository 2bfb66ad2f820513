// Slopes kept from one polish to the next: what is known is not simulated, and of a linear system nothing is lost by it.

#include "tools/diagnose/forward/slopes.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace feedtwin {
namespace {

using namespace tools::diagnosis;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Eigen::Index numbers = 3, all_unknowns = 5;

/// A run whose command is a linear map of the unknowns, and how many points it was asked for.
struct LinearRun {
  MatrixXd map = MatrixXd();
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

/// Of two runs the second one's slopes are known, from some point.
class SlopesOfRandomRuns : public testing::TestWithParam<unsigned> {
 protected:
  SlopesOfRandomRuns() {
    srand(GetParam());
    run_.map = MatrixXd::Random(20, all_unknowns);
    const MatrixXd points = differences_somewhere(1e-3);
    slopes_.learn(1, points, run_(points));
    run_.asked = 0;
  }
  static MatrixXd differences_somewhere(double step) { return forward_differences(VectorXd::Random(all_unknowns), step); }
  std::vector<tools::Simulated> simulated(std::size_t run, const MatrixXd& points, int shared = numbers) {
    return slopes_.simulated(run, points, shared, [this](const MatrixXd& asked) { return run_(asked); });
  }

  LinearRun run_;
  Slopes slopes_{2};
};

TEST_P(SlopesOfRandomRuns, OnlyTheEffectsOwnUnknownsAreSimulatedAgainAndTheResultIsTheSame) {
  const MatrixXd points = differences_somewhere(-2e-3);
  const auto found = simulated(1, points);
  EXPECT_EQ(run_.asked, 1 + all_unknowns - numbers);
  const auto truth = run_(points);
  ASSERT_EQ(found.size(), truth.size());
  for (std::size_t p = 0; p < found.size(); ++p) {
    ASSERT_EQ(found[p].torque_Nm.size(), 20U);
    for (std::size_t k = 0; k < truth[p].torque_Nm.size(); ++k)
      EXPECT_NEAR(found[p].torque_Nm[k], truth[p].torque_Nm[k], 1e-12) << p;
  }
}

TEST_P(SlopesOfRandomRuns, WhereTheEffectsAreTheSameTheirsAreKnownToo) {
  const MatrixXd points = differences_somewhere(1e-3);
  const auto found = simulated(1, points, all_unknowns);
  EXPECT_EQ(run_.asked, 1);
  const auto truth = run_(points);
  for (std::size_t p = 0; p < found.size(); ++p)
    for (std::size_t k = 0; k < truth[p].torque_Nm.size(); ++k)
      EXPECT_NEAR(found[p].torque_Nm[k], truth[p].torque_Nm[k], 1e-12) << p;
}

TEST_P(SlopesOfRandomRuns, OfAnUnknownThatIsNewItsPointIsSimulated) {
  const Slopes fewer = [&] {
    LinearRun run;
    run.map = run_.map.leftCols(all_unknowns - 1);
    Slopes made(1);
    const MatrixXd points = forward_differences(VectorXd::Random(all_unknowns - 1), 1e-3);
    made.learn(0, points, run(points));
    return made;
  }();
  const MatrixXd points = differences_somewhere(1e-3);
  const auto found = fewer.simulated(0, points, all_unknowns, [this](const MatrixXd& asked) { return run_(asked); });
  EXPECT_EQ(run_.asked, 2);
  EXPECT_EQ(found.size(), 1U + all_unknowns);
}

TEST_P(SlopesOfRandomRuns, OfARunThatWasNotSeenEveryPointIsSimulated) {
  EXPECT_EQ(simulated(0, differences_somewhere(1e-3)).size(), 1U + all_unknowns);
  EXPECT_EQ(run_.asked, 1 + all_unknowns);
}

TEST_P(SlopesOfRandomRuns, PointsThatAreNoDifferencesAreAllSimulated) {
  EXPECT_EQ(simulated(1, MatrixXd::Random(all_unknowns, all_unknowns + 1)).size(), 1U + all_unknowns);
  EXPECT_EQ(run_.asked, 1 + all_unknowns);
}

INSTANTIATE_TEST_SUITE_P(Seeds, SlopesOfRandomRuns, testing::Range(1U, 6U));

}  // namespace
}  // namespace feedtwin

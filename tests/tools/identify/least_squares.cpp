#include "tools/identify/least_squares.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace feedtwin::tools {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

LeastSquaresProblem within(Index unknowns, double low, double high) {
  LeastSquaresProblem problem;
  problem.start = VectorXd::Zero(unknowns);
  problem.lowest = VectorXd::Constant(unknowns, low);
  problem.highest = VectorXd::Constant(unknowns, high);
  problem.step = VectorXd::Constant(unknowns, 1e-6);
  return problem;
}

MatrixXd random_matrix(std::mt19937_64& random, Index rows, Index columns) {
  std::normal_distribution<double> unit;
  MatrixXd m(rows, columns);
  for (double& value : m.reshaped()) value = unit(random);
  return m;
}

/// Six unknowns that forty rows are linear in: ax - b.
struct LinearProblem {
  MatrixXd a;
  VectorXd b;
  LeastSquaresProblem problem = within(6, -100.0, 100.0);
  int batches = 0;

  explicit LinearProblem(std::mt19937_64& random) : a(random_matrix(random, 40, 6)), b(random_matrix(random, 40, 1)) {
    problem.residuals = [this](const MatrixXd& points) { return ++batches, MatrixXd((a * points).colwise() - b); };
  }
  LinearProblem(const LinearProblem&) = delete;
  LinearProblem& operator=(const LinearProblem&) = delete;

  /// The least that the first so many unknowns leave.
  [[nodiscard]] double least_cost(Index unknowns) const {
    const auto columns = a.leftCols(unknowns);
    return 0.5 * (columns * columns.colPivHouseholderQr().solve(b) - b).squaredNorm();
  }
};

TEST(LeastSquares, SolvesLinearProblemsAsQrDoes) {
  std::mt19937_64 random(71);
  for (int round = 0; round < 30; ++round) {
    const LinearProblem linear(random);
    const auto found = solve_least_squares(linear.problem);
    const VectorXd right = linear.a.colPivHouseholderQr().solve(linear.b);
    EXPECT_TRUE(found.converged) << round;
    EXPECT_LT((found.point - right).norm(), 1e-5 * (1.0 + right.norm())) << round;
    EXPECT_LT((found.jacobian - linear.a).norm(), 1e-6 * linear.a.norm()) << round;
  }
}

TEST(LeastSquares, FollowsACurvedValley) {
  auto problem = within(2, -10.0, 10.0);
  problem.start << -1.2, 1.0;
  problem.most_iterations = 200;
  problem.cost_tolerance = 1e-14;
  problem.residuals = [](const MatrixXd& points) {
    MatrixXd r(2, points.cols());
    r.row(0) = 10.0 * (points.row(1).array() - points.row(0).array().square());
    r.row(1) = 1.0 - points.row(0).array();
    return r;
  };
  const auto found = solve_least_squares(problem);
  EXPECT_NEAR(found.point[0], 1.0, 1e-4);
  EXPECT_NEAR(found.point[1], 1.0, 1e-4);
}

// The optimum of a bounded linear problem obeys Karush, Kuhn and Tucker: no gradient inside, one that pushes outwards on a
// bound.
TEST(LeastSquares, StopsAtBoundsThatHold) {
  std::mt19937_64 random(72);
  for (int round = 0; round < 50; ++round) {
    const MatrixXd a = random_matrix(random, 30, 5);
    const VectorXd b = 3.0 * random_matrix(random, 30, 1);
    auto problem = within(5, -0.2, 0.3);
    problem.most_iterations = 200;
    problem.cost_tolerance = 1e-13;
    problem.residuals = [&](const MatrixXd& points) {
      EXPECT_TRUE((points.array() >= -0.2 - 1e-12).all() && (points.array() <= 0.3 + 1e-12).all());
      return MatrixXd((a * points).colwise() - b);
    };
    const auto found = solve_least_squares(problem);
    EXPECT_TRUE(found.converged) << round;
    const VectorXd gradient = a.transpose() * (a * found.point - b);
    for (Index i = 0; i < 5; ++i) {
      if (found.point[i] <= -0.2 + 1e-9) {
        EXPECT_GT(gradient[i], -1e-2) << round;
      } else if (found.point[i] >= 0.3 - 1e-9) {
        EXPECT_LT(gradient[i], 1e-2) << round;
      } else {
        EXPECT_NEAR(gradient[i], 0.0, 1e-2) << round;
      }
    }
  }
}

// Slopes that are no numbers make a step that is none: nothing is asked there.
TEST(LeastSquares, AsksForNumbersOnly) {
  auto problem = within(2, -10.0, 10.0);
  problem.start << 1.0, 1.0;
  int asked = 0;
  problem.residuals = [&asked](const MatrixXd& points) {
    asked += static_cast<int>(points.cols());
    EXPECT_TRUE(points.allFinite());
    MatrixXd r = points;
    for (Index i = 0; i < points.cols(); ++i)
      if (points(1, i) != 1.0) r(1, i) = std::nan("");
    return r;
  };
  const auto found = solve_least_squares(problem);
  EXPECT_GT(asked, 3) << "beyond the slopes";
  EXPECT_TRUE(found.point.allFinite());
}

TEST(LeastSquares, AvoidsPointsWithoutAValue) {
  auto problem = within(1, -10.0, 10.0);
  problem.start << 4.0;
  problem.residuals = [](const MatrixXd& points) {
    MatrixXd r = points.array() - 1.0;
    for (double& value : r.reshaped()) {
      if (value < -0.5) value = std::numeric_limits<double>::quiet_NaN();
    }
    return r;
  };
  EXPECT_NEAR(solve_least_squares(problem).point[0], 1.0, 1e-4);
}

/// Forces of springs that stiffen: twenty unknowns that no single linear step finds.
LeastSquaresProblem stiffening_springs(std::mt19937_64& random, double noise_N = 1.0) {
  auto problem = within(20, -3.0, 3.0);
  problem.residuals = [a = random_matrix(random, 200, 20),
                       noise = VectorXd(noise_N * random_matrix(random, 200, 1))](const auto& points) {
    const Eigen::ArrayXXd stretched = (a * points).colwise() + 2.0 * a.col(0);
    return MatrixXd((stretched + 0.1 * stretched.cube()).matrix().colwise() - noise);
  };
  return problem;
}

// Where slopes cost many simulations, and a step few: further with the same number of slopes, and to the same minimum.
TEST(LeastSquares, KeptStepsComeFurtherOnTheSameSlopes) {
  std::mt19937_64 random(73);
  for (int round = 0; round < 20; ++round) {
    auto problem = stiffening_springs(random);
    const auto full = solve_least_squares(problem);
    problem.most_iterations = 2;
    const auto short_of = solve_least_squares(problem);
    problem.kept_steps = 2;
    const auto further = solve_least_squares(problem);
    problem.most_iterations = 30;
    const auto kept = solve_least_squares(problem);
    EXPECT_LT(further.cost - full.cost, 0.5 * (short_of.cost - full.cost)) << round;
    EXPECT_TRUE(kept.converged) << round;
    EXPECT_NEAR(kept.cost, full.cost, 1e-5 * full.cost) << round;
  }
}

// What slopes at the start do not show bends the way: full steps go too far, again and again, and shorter ones must not be
// taken for the end of it.
TEST(LeastSquares, KeptStepsGoOnWhereFullOnesGoTooFar) {
  std::mt19937_64 random(77);
  for (int round = 0; round < 20; ++round) {
    auto problem = within(20, -30.0, 30.0);
    VectorXd scale(20);
    for (Index i = 0; i < 20; ++i) scale[i] = std::pow(10.0, -0.1 * static_cast<double>(i));
    problem.residuals = [a = MatrixXd(random_matrix(random, 60, 20) * scale.asDiagonal()),
                         b = VectorXd(10.0 * random_matrix(random, 60, 1))](const MatrixXd& points) {
      MatrixXd all(80, points.cols());
      all << (a * points).colwise() - b, 0.2 * points.array().square().matrix();
      return all;
    };
    problem.most_iterations = 200;
    const auto full = solve_least_squares(problem);
    problem.kept_steps = 2;
    const auto kept = solve_least_squares(problem);
    EXPECT_LT(kept.cost, 1.01 * full.cost) << round;
  }
}

// On slopes that are never taken anew what each step saw must mend them, or four more steps arrive far less close.
TEST(LeastSquares, EachKeptStepMendsTheSlopes) {
  std::mt19937_64 random(75);
  std::vector<double> left;
  for (int round = 0; round < 20; ++round) {
    auto problem = stiffening_springs(random, 1e-6);
    problem.cost_tolerance = 1e-12;
    const auto full = solve_least_squares(problem);
    problem.start = full.point + 0.2 * random_matrix(random, 20, 1);
    problem.most_iterations = 1;
    problem.kept_steps = 4;
    const auto kept = solve_least_squares(problem);
    left.push_back(kept.cost / full.cost);
  }
  std::ranges::nth_element(left, left.begin() + 10);
  EXPECT_LT(left[10], 1e7);  // on the same slopes uncorrected 5e8
}

// A cost in nats: what brings less than is asked is not waited for.
TEST(LeastSquares, EndsWhereAStepIsWorthLessThanAsked) {
  std::mt19937_64 random(74);
  for (int round = 0; round < 20; ++round) {
    auto problem = stiffening_springs(random);
    const auto fine = solve_least_squares(problem);
    problem.least_fall = 0.02 * fine.cost;
    const auto coarse = solve_least_squares(problem);
    EXPECT_TRUE(fine.converged && coarse.converged) << round;
    EXPECT_LT(coarse.cost, fine.cost + problem.least_fall) << round;
    EXPECT_LT(coarse.iterations, fine.iterations) << round;
  }
}

// A question whose answer straight slopes know already costs one batch and no step.
TEST(LeastSquares, TakesNoStepWhereWhatIsAskedPromisesTooLittle) {
  std::mt19937_64 random(76);
  for (int round = 0; round < 20; ++round) {
    LinearProblem linear(random);
    const double worth = linear.least_cost(4) - linear.least_cost(6);
    linear.problem.kept_steps = 2;
    linear.problem.asked = 2;
    linear.problem.least_promise = 1.01 * worth;
    EXPECT_EQ(solve_least_squares(linear.problem).point, linear.problem.start) << round;
    EXPECT_EQ(linear.batches, 1) << round;
    linear.problem.least_promise = 0.99 * worth;
    EXPECT_NEAR(solve_least_squares(linear.problem).cost, linear.least_cost(6), 2e-6 * linear.least_cost(6)) << round;
  }
}

// Compared with another that is far ahead: it ends where it can no more catch up, and goes on to the end where it can.
TEST(LeastSquares, EndsWhereItIsHopelesslyBehind) {
  std::mt19937_64 random(78);
  for (int round = 0; round < 20; ++round) {
    auto problem = stiffening_springs(random);
    const auto alone = solve_least_squares(problem);
    const MatrixXd residuals = problem.residuals(problem.start);
    const double at_start = 0.5 * residuals.squaredNorm();
    const double level_nats = 0.5 * static_cast<double>(residuals.size()) * std::log(at_start / alone.cost);
    problem.behind_nats = level_nats;
    EXPECT_EQ(solve_least_squares(problem).point, alone.point) << round << ": it ends level";
    problem.behind_nats = 20.0 * level_nats;
    const auto hopeless = solve_least_squares(problem);
    EXPECT_LT(hopeless.iterations, alone.iterations) << round;
    EXPECT_LT(hopeless.cost, at_start) << round << ": not before a step was taken";
    EXPECT_FALSE(hopeless.converged) << round;
  }
}

TEST(LeastSquares, SaysWhenItRanOutOfIterations) {
  auto problem = within(1, -1e9, 1e9);
  problem.start << 1e6;
  problem.most_iterations = 2;
  problem.residuals = [](const MatrixXd& points) { return MatrixXd(points.array().exp().min(1e100) + 1.0); };
  problem.start << 20.0;
  EXPECT_FALSE(solve_least_squares(problem).converged);
}

}  // namespace
}  // namespace feedtwin::tools

#include "tools/identify/least_squares.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace feedtwin::tools {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double cost_of(const Eigen::Ref<const VectorXd>& residuals) {
  const double cost = 0.5 * residuals.squaredNorm();
  return std::isfinite(cost) ? cost : std::numeric_limits<double>::infinity();
}

/// Forward differences, backward where a bound is in the way; the point itself comes along in the first column.
void linearise(const LeastSquaresProblem& problem, LeastSquaresSolution& at) {
  const Index n = at.point.size();
  MatrixXd points = at.point.replicate(1, n + 1);
  VectorXd step = problem.step;
  for (Index i = 0; i < n; ++i) {
    if (at.point[i] + step[i] > problem.highest[i]) step[i] = -step[i];
    points(i, i + 1) += step[i];
  }
  const MatrixXd residuals = problem.residuals(points);
  at.residuals = residuals.col(0);
  at.cost = cost_of(at.residuals);
  at.jacobian.resize(residuals.rows(), n);
  for (Index i = 0; i < n; ++i) at.jacobian.col(i) = (residuals.col(i + 1) - residuals.col(0)) / step[i];
}

/// The damped step, with unknowns that push against a bound held there.
VectorXd damped_point(const LeastSquaresProblem& problem, const LeastSquaresSolution& at, const MatrixXd& normal,
                      const VectorXd& gradient, double damping) {
  const Index n = at.point.size();
  std::vector<bool> held(static_cast<std::size_t>(n), false);
  VectorXd point = at.point;
  for (int pass = 0; pass < 3; ++pass) {
    MatrixXd a = normal;
    VectorXd b = -gradient;
    for (Index i = 0; i < n; ++i) {
      a(i, i) += damping * std::max(normal(i, i), 1e-12);
      if (!held[static_cast<std::size_t>(i)]) continue;
      a.row(i).setZero();
      a.col(i).setZero();
      a(i, i) = 1.0;
      b[i] = 0.0;
    }
    const VectorXd step = a.ldlt().solve(b);
    point = (at.point + step).cwiseMax(problem.lowest).cwiseMin(problem.highest);
    bool again = false;
    for (Index i = 0; i < n; ++i) {
      const bool outside =
          point[i] != at.point[i] + step[i] && (at.point[i] == problem.lowest[i] || at.point[i] == problem.highest[i]);
      again = again || (outside && !held[static_cast<std::size_t>(i)]);
      if (outside) held[static_cast<std::size_t>(i)] = true;
    }
    if (!again) break;
  }
  return point;
}

}  // namespace

LeastSquaresSolution solve_least_squares(const LeastSquaresProblem& problem) {
  // the factors on the damping that one batch tries at once
  constexpr std::array trials{0.0, 1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e4};
  LeastSquaresSolution at;
  at.point = problem.start.cwiseMax(problem.lowest).cwiseMin(problem.highest);
  double damping = 1e-2;
  for (; at.iterations < problem.most_iterations; ++at.iterations) {
    linearise(problem, at);
    const MatrixXd normal = at.jacobian.transpose() * at.jacobian;
    const VectorXd gradient = at.jacobian.transpose() * at.residuals;
    MatrixXd points(at.point.size(), static_cast<Index>(trials.size()));
    for (Index i = 0; i < points.cols(); ++i) {
      points.col(i) = damped_point(problem, at, normal, gradient, damping * trials[static_cast<std::size_t>(i)]);
    }
    const MatrixXd residuals = problem.residuals(points);
    Index best = 0;
    for (Index i = 1; i < points.cols(); ++i) {
      if (cost_of(residuals.col(i)) < cost_of(residuals.col(best))) best = i;
    }
    const double fall = at.cost - cost_of(residuals.col(best));
    if (!(fall > problem.cost_tolerance * at.cost)) {
      at.converged = true;
      if (fall <= 0.0) return at;
    }
    at.point = points.col(best);
    damping = std::clamp(damping * std::max(trials[static_cast<std::size_t>(best)], 1e-3), 1e-9, 1e6);
    if (at.converged) break;
  }
  linearise(problem, at);
  return at;
}

}  // namespace feedtwin::tools

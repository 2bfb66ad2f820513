#include "tools/identify/least_squares.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "tools/large_blocks.h"
#include "tools/linear_systems.h"
#include "tools/parallel.h"

namespace feedtwin::tools {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double cost_of(const Eigen::Ref<const VectorXd>& residuals) {
  const double cost = 0.5 * residuals.squaredNorm();
  return std::isfinite(cost) ? cost : std::numeric_limits<double>::infinity();
}

/// On all cores: a Jacobian of some hundred thousand rows goes no faster than memory gives it.
template <class Matrix, class Work>
void for_each_column(Matrix& matrix, const Work& work) {
  parallel_for(static_cast<std::size_t>(matrix.cols()),
               [&](std::size_t i) { work(static_cast<Index>(i), matrix.col(static_cast<Index>(i))); });
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
  ask_for_large_pages(at.jacobian);
  for_each_column(at.jacobian, [&](Index i, auto column) { column = (residuals.col(i + 1) - residuals.col(0)) / step[i]; });
}

/// The damped step within the bounds: an unknown that it would take beyond one goes as far as that, and the others make the
/// best of it; one that then would rather come back is let go again (Lawson, Hanson: bounded least squares).
VectorXd damped_point(const LeastSquaresProblem& problem, const LeastSquaresSolution& at, const MatrixXd& normal,
                      const VectorXd& gradient, double damping) {
  constexpr int most_passes = 12;
  const Index n = at.point.size();
  MatrixXd damped = normal;
  damped.diagonal() += damping * normal.diagonal().cwiseMax(1e-12);
  std::vector<bool> held(static_cast<std::size_t>(n), false);
  VectorXd bounded = VectorXd::Zero(n), point = at.point;  // how far the held ones go
  for (int pass = 0; pass < most_passes; ++pass) {
    MatrixXd a = damped;
    VectorXd b = -gradient - damped * bounded;
    for (Index i = 0; i < n; ++i) {
      if (!held[static_cast<std::size_t>(i)]) continue;
      a.row(i).setZero();
      a.col(i).setZero();
      a(i, i) = 1.0;
      b[i] = bounded[i];
    }
    const VectorXd wanted = at.point + solved(a, b);
    point = wanted.cwiseMax(problem.lowest).cwiseMin(problem.highest);
    bool again = false;
    for (Index i = 0; i < n; ++i) {
      if (point[i] == wanted[i] || held[static_cast<std::size_t>(i)]) continue;
      held[static_cast<std::size_t>(i)] = again = true;
      bounded[i] = point[i] - at.point[i];
    }
    if (again) continue;
    const VectorXd slope = damped * (point - at.point) + gradient;
    for (Index i = 0; i < n && !again; ++i) {
      const bool inwards = point[i] == problem.highest[i] ? slope[i] > 0.0 : slope[i] < 0.0;
      if (!held[static_cast<std::size_t>(i)] || !inwards) continue;
      held[static_cast<std::size_t>(i)] = false;
      bounded[i] = 0.0;
      again = true;
    }
    if (!again) break;
  }
  return point;
}

/// Slopes under which the step would have ended where it did, and no others than needed, all unknowns by their own measure.
void correct_slopes(LeastSquaresSolution& at, const VectorXd& moved, const VectorXd& residuals) {
  VectorXd measured(moved.size());
  for_each_column(at.jacobian, [&](Index i, auto column) { measured[i] = column.squaredNorm() * moved[i]; });
  const double length = measured.dot(moved);
  if (!(length > 0.0)) return;
  const VectorXd missed = residuals - at.residuals - at.jacobian * moved;
  for_each_column(at.jacobian, [&](Index i, auto column) { column += missed * (measured[i] / length); });
}

/// The best of the steps that one batch tries at once.
struct Step {
  VectorXd point, residuals;
  double fall = 0.0, factor = 0.0;  ///< of the cost; on the damping
};

/// Of the steps that a damping's factors make the best, by the residuals of one batch.
Step best_of(const LeastSquaresProblem& problem, const LeastSquaresSolution& at, const MatrixXd& normal,
             const VectorXd& gradient, double damping, std::span<const double> factors) {
  MatrixXd points(at.point.size(), static_cast<Index>(factors.size()));
  for (Index i = 0; i < points.cols(); ++i) {
    points.col(i) = damped_point(problem, at, normal, gradient, damping * factors[static_cast<std::size_t>(i)]);
    if (!points.col(i).allFinite()) points.col(i) = at.point;  // no numbers are no axis to simulate
  }
  const MatrixXd residuals = problem.residuals(points);
  Index best = 0;
  for (Index i = 1; i < points.cols(); ++i)
    if (cost_of(residuals.col(i)) < cost_of(residuals.col(best))) best = i;
  const double fall = at.cost - cost_of(residuals.col(best));
  return {points.col(best), residuals.col(best), fall, factors[static_cast<std::size_t>(best)]};
}

/// With fresh slopes shorter steps are tried as long as none goes down; `damping` is what it took.
Step best_step(const LeastSquaresProblem& problem, const LeastSquaresSolution& at, bool fresh, double& damping) {
  constexpr double strongest_damping = 1e6;  // a step of a millionth of Newton's: there is no way down
  constexpr std::array many{0.0, 1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e4};
  constexpr std::array bold{0.0, 1.0}, shorter{30.0, 1e3};  // where slopes are kept a step costs as they do
  const MatrixXd normal = gram(at.jacobian);
  const VectorXd gradient = transposed_times(at.jacobian, at.residuals);
  for (;;) {
    const auto best_by = [&](std::span<const double> factors) {
      return best_of(problem, at, normal, gradient, damping, factors);
    };
    Step step = best_by(problem.kept_steps > 0 ? std::span<const double>(bold) : std::span<const double>(many));
    if (problem.kept_steps > 0 && !(step.fall > 0.0)) step = best_by(shorter);
    const double shortest = problem.kept_steps > 0 ? shorter.back() : many.back();
    if (step.fall > 0.0 || !fresh || damping * shortest >= strongest_damping) return step;
    damping = std::max(damping, 1e-4) * shortest;  // no step that bold goes down: shorter ones
  }
}

/// Fall of the cost that straight slopes promise in the first so many unknowns.
double promise(const MatrixXd& normal, const VectorXd& gradient, Index unknowns) {
  MatrixXd a = normal.topLeftCorner(unknowns, unknowns);
  a.diagonal() += 1e-9 * a.diagonal();
  const VectorXd g = gradient.head(unknowns);
  return 0.5 * g.dot(solved(a, g));
}

/// What the unknowns that are asked about promise beyond the others.
double promise_of_asked(const LeastSquaresProblem& problem, const LeastSquaresSolution& at) {
  const MatrixXd normal = gram(at.jacobian);
  const VectorXd gradient = transposed_times(at.jacobian, at.residuals);
  const Index all = gradient.size();
  return promise(normal, gradient, all) - promise(normal, gradient, all - problem.asked);
}

/// How much likelier so many residuals of a size that is not known are with the lesser cost: half of what it falls by, as a
/// share, for each; the fall itself where that is little and the residuals are in deviations.
double nats(double before, double after, Index residuals) {
  return after > 0.0 ? 0.5 * static_cast<double>(residuals) * std::log(before / after) : 0.0;
}

}  // namespace

LeastSquaresSolution solve_least_squares(const LeastSquaresProblem& problem) {
  const bool keeps = problem.kept_steps > 0;
  LeastSquaresSolution at;
  at.point = problem.start.cwiseMax(problem.lowest).cwiseMin(problem.highest);
  constexpr double hopeless = 0.05;  // of what is left
  double behind_nats = problem.behind_nats;
  constexpr double bold_damping = 0.3;
  const double least_factor = keeps ? 0.1 : 1e-3;
  double damping = 1e-2;
  for (; at.iterations < problem.most_iterations; ++at.iterations) {
    linearise(problem, at);
    if (at.iterations == 0 && problem.asked > 0 && promise_of_asked(problem, at) < problem.least_promise) {
      at.converged = true;
      return at;
    }
    const double before = at.cost;
    if (keeps) damping = bold_damping;  // how short steps had to be says nothing of these slopes
    for (int kept = 0; kept <= problem.kept_steps; ++kept) {
      const double least = std::max(problem.least_fall, problem.cost_tolerance * at.cost);
      const Step step = best_step(problem, at, kept == 0, damping);
      if (kept == 0) at.converged = !(step.fall > least);
      if (step.fall <= 0.0) break;
      if (keeps) correct_slopes(at, step.point - at.point, step.residuals);
      damping = std::clamp(damping * std::max(step.factor, least_factor), 1e-3, 1e6);
      at.point = step.point;
      at.residuals = step.residuals;
      at.cost = cost_of(step.residuals);
      if (!(step.fall > least)) break;
    }
    if (at.converged) return at;  // a step of no consequence: the slopes stay
    const double fall_nats = nats(before, at.cost, at.residuals.size());
    behind_nats -= fall_nats;
    if (fall_nats < hopeless * behind_nats) return at;
  }
  if (!keeps) linearise(problem, at);
  return at;
}

}  // namespace feedtwin::tools

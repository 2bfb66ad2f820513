#pragma once
// Nonlinear least squares within bounds: Levenberg-Marquardt whose residuals are asked for several points at a time, so that
// a Jacobian by forward differences, and then a row of trial steps, each cost one batch simulation.
//
// Ceres evaluates one point at a time through templates or cost-function objects; our residuals come in lanes. The normal
// equations are small (about forty unknowns), so the method itself is a page.

#include <Eigen/Core>
#include <functional>

namespace feedtwin::tools {

struct LeastSquaresProblem {
  Eigen::VectorXd start, lowest, highest;
  Eigen::VectorXd step;  ///< for forward differences, > 0
  /// One column of residuals for each column of points.
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd& points)> residuals;
  int most_iterations = 30;
  double cost_tolerance = 1e-7;  ///< relative fall of the cost below which the search ends
  double least_fall = 0.0;       ///< likewise, of the cost itself
  /// Further steps on the same slopes, corrected by what each step saw (Broyden 1965), where slopes cost many simulations;
  /// then few lengths of a step are tried at once rather than many.
  int kept_steps = 0;
  /// Of the last so many unknowns it is asked whether they bring anything: where straight slopes promise less of them,
  /// beyond what the others would bring, the search ends where it starts.
  Eigen::Index asked = 0;
  double least_promise = 0.0;  ///< fall of the cost
  /// By how much another is likelier than the start. Where all steps along some slopes bring little of what is left of
  /// that, the search ends: whoever asks has his answer.
  double behind_nats = 0.0;
};

struct LeastSquaresSolution {
  Eigen::VectorXd point;
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;  ///< at the point, or one converged step before it; kept steps correct it
  double cost = 0.0;         ///< half the sum of squares
  int iterations = 0;
  bool converged = false;
};

/// @throws nothing of its own; a point whose residuals are not finite counts as infinitely bad.
[[nodiscard]] LeastSquaresSolution solve_least_squares(const LeastSquaresProblem& problem);

}  // namespace feedtwin::tools

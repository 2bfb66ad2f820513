#include "tools/identify/output_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "tools/identify/fit_covariance.h"
#include "tools/identify/joint_intervals.h"
#include "tools/identify/least_squares.h"
#include "tools/identify/residual_stack.h"
#include "tools/identify/rounding_effect.h"
#include "tools/intervals.h"

namespace feedtwin::tools {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double difference_step = 1e-4, largest_step = 0.03;  // of a parameter's scale
constexpr double step_deviations = 2.0;                        // of an unknown alone, over which differences are taken

/// Differences are taken over about what the data can tell apart: sticking and reversals make the residuals of a short step
/// jump, and a derivative across such a jump would be called knowledge.
void adapt_steps(const LeastSquaresSolution& at, const std::vector<FitParameter>& parameters, VectorXd& step) {
  for (Index i = 0; i < step.size(); ++i) {
    const auto& p = parameters[static_cast<std::size_t>(i)];
    const double alone = 1.0 / std::max(at.jacobian.col(i).norm(), 1e-12);  // deviation with all others known
    step[i] = std::clamp(step_deviations * alone, difference_step * p.scale, largest_step * p.scale);
  }
}

/// Slopes at a solution from differences to either side. Row by row the gentler one counts, none where they disagree in
/// sign: a jump stands on one side only, and is no knowledge.
void linearise_both_ways(const LeastSquaresProblem& problem, LeastSquaresSolution& at) {
  constexpr double at_bound = 1e-3;  // of a step: what is left up to a bound is rounding, and no difference
  const Index n = at.point.size();
  MatrixXd points = at.point.replicate(1, 2 * n);
  for (Index i = 0; i < n; ++i) {
    points(i, 2 * i) = std::min(at.point[i] + problem.step[i], problem.highest[i]);
    points(i, 2 * i + 1) = std::max(at.point[i] - problem.step[i], problem.lowest[i]);
  }
  const MatrixXd residuals = problem.residuals(points);
  for (Index i = 0; i < n; ++i) {
    const double least = at_bound * problem.step[i];
    double ahead = points(i, 2 * i) - at.point[i], back = at.point[i] - points(i, 2 * i + 1);
    if (ahead < least) ahead = 0.0;
    if (back < least) back = 0.0;
    for (Index row = 0; row < residuals.rows(); ++row) {
      const double here = at.residuals[row];
      const double right = ahead > 0.0 ? (residuals(row, 2 * i) - here) / ahead : 0.0;
      const double left = back > 0.0 ? (here - residuals(row, 2 * i + 1)) / back : 0.0;
      if (ahead <= 0.0 || back <= 0.0) {
        at.jacobian(row, i) = right + left;
      } else {
        at.jacobian(row, i) = right * left <= 0.0 ? 0.0 : std::abs(right) < std::abs(left) ? right : left;
      }
    }
  }
}

LeastSquaresProblem problem_for(const std::vector<FitParameter>& parameters, ResidualStack& stack,
                                const OutputErrorSettings& settings) {
  const auto n = static_cast<Index>(parameters.size());
  LeastSquaresProblem problem;
  for (auto* vector : {&problem.start, &problem.lowest, &problem.highest, &problem.step}) vector->resize(n);
  for (Index i = 0; i < n; ++i) {
    const auto& p = parameters[static_cast<std::size_t>(i)];
    problem.start[i] = p.start.value_or(p.nominal);
    problem.lowest[i] = p.lowest;
    problem.highest[i] = p.highest;
    problem.step[i] = difference_step * p.scale;
  }
  problem.residuals = [&stack](const MatrixXd& points) { return stack(points); };
  problem.most_iterations = settings.most_iterations;
  problem.kept_steps = settings.kept_steps;
  problem.least_fall = settings.least_fall;
  problem.asked = settings.asked;
  problem.least_promise = settings.least_promise;
  problem.behind_nats = settings.behind_nats;
  return problem;
}

}  // namespace

VectorXd OutputErrorFit::point() const {
  VectorXd values(static_cast<Index>(parameters.size()));
  for (Index i = 0; i < values.size(); ++i) values[i] = parameters[static_cast<std::size_t>(i)].value;
  return values;
}

OutputErrorFit fit_output_error(const std::vector<ClosedLoopRun>& runs, const std::vector<FitParameter>& parameters,
                                const BatchSimulator& simulate, const OutputErrorSettings& settings) {
  ResidualStack stack(runs, parameters, simulate, settings);
  LeastSquaresProblem problem = problem_for(parameters, stack, settings);
  LeastSquaresSolution at;
  // white rows are told far more nats than coloured ones are worth, and all is weighed anew
  constexpr double first_falls = 10.0;
  for (int round = 0; round < settings.rounds; ++round) {
    if (settings.round_begins) settings.round_begins(round);
    if (round > 0) problem.asked = 0, problem.behind_nats = 0.0;
    problem.least_fall = settings.least_fall * (round + 1 < settings.rounds ? first_falls : 1.0);
    stack.weigh(problem.start, round > 0 || settings.coloured_from_start, round > 0);
    at = solve_least_squares(problem);
    if (settings.progress) {
      settings.progress(fmt::format("round {} of {}: {} iterations, weighted rms {:.4f}", round + 1, settings.rounds,
                                    at.iterations, std::sqrt(2.0 * at.cost / static_cast<double>(at.residuals.size()))));
    }
    problem.start = at.point;
    adapt_steps(at, parameters, problem.step);
  }
  OutputErrorFit fit;
  fit.covariance = MatrixXd::Zero(at.point.size(), at.point.size());
  MatrixXd rounding = fit.covariance;
  if (settings.intervals) {
    linearise_both_ways(problem, at);
    const MatrixXd inverse = inverse_information(at);
    rounding = rounding_effect(at, inverse, stack, settings.encoder_grids);
    fit.covariance = covariance_of(at, stack, inverse, rounding);
    fit.trades = trades_of(fit.covariance, parameters, settings.told_below);
  }
  fit.cost = at.cost;
  fit.residuals = static_cast<std::size_t>(at.residuals.size() - stack.prior_rows());
  fit.simulations = stack.simulations();
  fit.converged = at.converged;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto index = static_cast<Index>(i);
    const double deviation = std::sqrt(fit.covariance(index, index));
    const double half = normal_90 * deviation, value = at.point[index];
    const double known = settings.prior > 0.0 ? 0.5 * settings.prior * parameters[i].prior : settings.told_below;
    const bool told = deviation < std::min(settings.told_below, known) * parameters[i].scale;
    fit.parameters.push_back({parameters[i],
                              value,
                              deviation,
                              {value - half, value + half},
                              told,
                              degrees_of_freedom(deviation * deviation, rounding(index, index), settings.encoder_grids)});
  }
  return fit;
}

MatrixXd first_fits(const std::vector<ClosedLoopRun>& runs, const std::vector<FitParameter>& parameters,
                    const BatchSimulator& simulate, const MatrixXd& starts, const OutputErrorSettings& settings) {
  ResidualStack stack(runs, parameters, simulate, settings);
  LeastSquaresProblem problem = problem_for(parameters, stack, settings);
  MatrixXd ends(starts.rows(), starts.cols());
  for (Index i = 0; i < starts.cols(); ++i) {
    problem.start = starts.col(i);
    stack.weigh(problem.start, false);
    ends.col(i) = solve_least_squares(problem).point;
  }
  return ends;
}

BatchCost output_error_cost(const std::vector<ClosedLoopRun>& runs, const std::vector<FitParameter>& parameters,
                            const BatchSimulator& simulate, const OutputErrorSettings& settings) {
  OutputErrorSettings alone = settings;  // columns are shared here, a cost each
  alone.ranks = nullptr;
  auto stack = std::make_shared<ResidualStack>(runs, parameters, simulate, alone);
  VectorXd start(static_cast<Index>(parameters.size()));
  for (Index i = 0; i < start.size(); ++i) {
    const auto& p = parameters[static_cast<std::size_t>(i)];
    start[i] = p.start.value_or(p.nominal);
  }
  stack->weigh(start, false);
  return [stack, ranks = settings.ranks](const MatrixXd& points) {
    const auto group = static_cast<Index>(lanes::best_kernel().width);
    const auto [first, last] =
        ranks != nullptr ? own_columns(*ranks, points.cols(), group) : std::pair<Index, Index>(0, points.cols());
    MatrixXd costs = MatrixXd::Zero(1, points.cols());
    for (Index at = first; at < last; at += 4 * group) {  // residuals of a few groups at a time are enough memory
      const Index count = std::min(4 * group, last - at);
      costs.middleCols(at, count) = 0.5 * (*stack)(points.middleCols(at, count)).colwise().squaredNorm();
    }
    if (ranks != nullptr) share_columns(*ranks, costs, group);
    return VectorXd(costs.row(0).transpose());
  };
}

}  // namespace feedtwin::tools

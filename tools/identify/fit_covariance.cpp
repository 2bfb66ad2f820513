#include "tools/identify/fit_covariance.h"

#include <algorithm>
#include <cmath>

#include "tools/linear_systems.h"

namespace feedtwin::tools {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t block_samples = 200;

}  // namespace

MatrixXd inverse_information(const LeastSquaresSolution& at) {
  const MatrixXd information = at.jacobian.transpose() * at.jacobian;
  return inverse_of(information);
}

MatrixXd covariance_of(const LeastSquaresSolution& at, const ResidualStack& stack, const MatrixXd& inverse,
                       const MatrixXd& rounding) {
  MatrixXd scores = MatrixXd::Zero(inverse.rows(), inverse.cols());
  const auto& starts = stack.starts();
  const std::size_t channels = stack.channels();
  for (std::size_t run = 0; run + channels < starts.size(); run += channels) {
    const Index blocks = std::max<Index>((starts[run + 1] - starts[run]) / static_cast<Index>(block_samples), 20);
    for (Index block = 0; block < blocks; ++block) {
      VectorXd score = VectorXd::Zero(inverse.rows());
      for (std::size_t s = run; s < run + channels; ++s) {
        const Index length = starts[s + 1] - starts[s];
        const Index first = starts[s] + length * block / blocks, end = starts[s] + length * (block + 1) / blocks;
        score += at.jacobian.middleRows(first, end - first).transpose() * at.residuals.segment(first, end - first);
      }
      scores += score * score.transpose();
    }
  }
  const Index data_rows = starts.back();
  const MatrixXd prior_jacobian = at.jacobian.bottomRows(at.jacobian.rows() - data_rows);
  scores += prior_jacobian.transpose() * prior_jacobian;
  const MatrixXd sandwich = inverse * scores * inverse;
  const VectorXd widen = (sandwich.diagonal().array() / inverse.diagonal().array()).max(1.0).sqrt();
  return widen.asDiagonal() * inverse * widen.asDiagonal() + rounding;
}

std::vector<Trade> trades_of(const MatrixXd& covariance, const std::vector<FitParameter>& parameters, double told_below) {
  VectorXd scale(covariance.rows());
  for (Index i = 0; i < scale.size(); ++i) scale[i] = parameters[static_cast<std::size_t>(i)].scale;
  const MatrixXd scaled = scale.cwiseInverse().asDiagonal() * covariance * scale.cwiseInverse().asDiagonal();
  const PrincipalAxes axes = principal_axes(scaled);
  std::vector<Trade> trades;
  for (Index d = scaled.rows() - 1; d >= 0; --d) {
    if (std::sqrt(std::max(axes.values[d], 0.0)) < told_below) break;
    const VectorXd direction = axes.vectors.col(d);
    Trade trade;
    for (Index i = 0; i < direction.size(); ++i) {
      if (std::abs(direction[i]) < 0.25) continue;
      trade.keys.push_back(parameters[static_cast<std::size_t>(i)].key);
      trade.weights.push_back(direction[i]);
    }
    trades.push_back(std::move(trade));
  }
  return trades;
}

}  // namespace feedtwin::tools

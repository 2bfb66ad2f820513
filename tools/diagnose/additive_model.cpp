#include "tools/diagnose/additive_model.h"

#include <algorithm>
#include <span>
#include <utility>

namespace feedtwin::tools::diagnosis {

void add_hats(double x, double low, double high, Index count, double weight, Eigen::Ref<Vector> row, Index from) {
  const double place = std::clamp((x - low) / (high - low + 1e-12), 0.0, 1.0) * static_cast<double>(count - 1);
  const Index i = std::min<Index>(static_cast<Index>(place), count - 2);
  const double share = place - static_cast<double>(i);
  row[from + i] += weight * (1.0 - share);
  row[from + i + 1] += weight * share;
}

AdditiveModel::AdditiveModel(Eigen::MatrixXd rows, const std::vector<std::size_t>& fold, const std::vector<Columns>& ways,
                             double rows_of_zero)
    : rows_(std::move(rows)), members_(fold.empty() ? 0 : *std::ranges::max_element(fold) + 1) {
  for (std::size_t k = 0; k < fold.size(); ++k) members_[fold[k]].push_back(static_cast<Index>(k));
  std::vector<Eigen::MatrixXd> normal;
  for (const auto& own : members_) {
    const Eigen::MatrixXd part = rows_(Eigen::all, own);
    normal.push_back(part * part.transpose());
  }
  for (const auto& columns : ways) {
    Way way{columns, {}};
    for (std::size_t f = 0; f < members_.size(); ++f) {
      Eigen::MatrixXd others = Eigen::MatrixXd::Zero(rows_.rows(), rows_.rows());
      for (std::size_t g = 0; g < members_.size(); ++g)
        if (g != f) others += normal[g];
      Eigen::MatrixXd own = others(way.columns, way.columns);
      for (Index i = 0; i < own.rows(); ++i) own(i, i) += rows_of_zero + 0.02 * own(i, i);
      way.solvers.emplace_back(own);
    }
    ways_.push_back(std::move(way));
  }
}

AdditiveModel::Unseen AdditiveModel::unseen(const Vector& y, std::size_t ways) const {
  std::vector<Vector> right;
  for (const auto& own : members_) right.push_back(rows_(Eigen::all, own) * y(own));
  Unseen best;
  double least = 1e300;
  for (std::size_t w = 0; w < ways; ++w) {
    const auto& way = ways_[w];
    Vector predicted = Vector::Zero(y.size());
    for (std::size_t f = 0; f < members_.size(); ++f) {
      Vector others = Vector::Zero(rows_.rows()), weight = others;
      for (std::size_t g = 0; g < members_.size(); ++g)
        if (g != f) others += right[g];
      const Vector right_side = others(way.columns), found = way.solvers[f].solve(right_side);
      weight(way.columns) = found;
      for (const Index k : members_[f]) predicted[k] = weight.dot(rows_.col(k));
    }
    const double error = (y - predicted).squaredNorm();
    if (error < least) least = error, best = {std::move(predicted), w};
  }
  return best;
}

}  // namespace feedtwin::tools::diagnosis

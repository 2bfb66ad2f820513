#pragma once
// An additive model judged where it was not learned: least squares of some columns on all folds of the rows but one, asked
// what it predicts of that one, in turn; of several choices of columns the one that predicts best.

#include <Eigen/Cholesky>
#include <vector>

#include "tools/diagnose/track.h"

namespace feedtwin::tools::diagnosis {

/// Hat functions over a range, at equal distances: adds them, times a weight, to one row.
void add_hats(double x, double low, double high, Index count, double weight, Eigen::Ref<Vector> row, Index from);

class AdditiveModel {
 public:
  using Columns = std::vector<Index>;

  AdditiveModel() = default;
  /// @param rows a column a moment @param fold of each @param ways which of the rows' entries are asked together
  /// @param rows_of_zero as if so many moments more had said zero
  AdditiveModel(Eigen::MatrixXd rows, const std::vector<std::size_t>& fold, const std::vector<Columns>& ways,
                double rows_of_zero);

  struct Unseen {
    Vector predicted;
    std::size_t way = 0;
  };
  /// By the best of the first so many ways.
  [[nodiscard]] Unseen unseen(const Vector& y, std::size_t ways) const;
  [[nodiscard]] std::size_t ways() const { return ways_.size(); }
  [[nodiscard]] Index moments() const { return rows_.cols(); }

 private:
  struct Way {
    Columns columns;
    std::vector<Eigen::LDLT<Eigen::MatrixXd>> solvers;  ///< from the other folds
  };
  Eigen::MatrixXd rows_;
  std::vector<std::vector<Index>> members_;  ///< of each fold
  std::vector<Way> ways_;
};

}  // namespace feedtwin::tools::diagnosis

#pragma once
// What of a power remainder is no meter's noise: powers that the recorded command and motion could make in any drive. A
// meter's noise is far below what a wrong number leaves over, so that the remainder itself cannot tell it.

#include <vector>

#include "tools/diagnose/inverse_model.h"

namespace feedtwin::tools::diagnosis {

class PowerStructure {
 public:
  explicit PowerStructure(const InverseModel& model);

  /// What of the power equation's residual is predicted on seconds that the prediction has not seen; zero elsewhere, and
  /// where nothing is.
  [[nodiscard]] Vector part_of(const Vector& residual) const;

 private:
  std::vector<Index> rows_;         ///< of the power equation, all runs in turn
  Eigen::MatrixXd columns_;         ///< a row each
  std::vector<std::size_t> folds_;  ///< of each
};

}  // namespace feedtwin::tools::diagnosis

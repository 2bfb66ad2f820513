#pragma once
// Which numbers of a model the closed loop moves, and where a Fit has them.

#include "tools/diagnose/fit.h"
#include "tools/identify/output_error.h"

namespace feedtwin::tools::diagnosis {

/// What an engine's own time step leaves of a number, measured where the truth is known (practice cases: 0.02 to 0.06 %).
inline constexpr double step_error = 5e-4;

class Unknowns {
 public:
  /// @param fitter and @param start must outlive this
  Unknowns(const Fitter& fitter, const Candidate& start);

  /// The nominal model's numbers, then the effects' own.
  [[nodiscard]] std::vector<FitParameter> parameters() const;
  /// Of the nominal model and the first so many effects.
  [[nodiscard]] Eigen::Index count(std::size_t effects) const;
  /// The start with these numbers.
  [[nodiscard]] Candidate at(const Eigen::Ref<const Eigen::VectorXd>& point) const;
  /// Covariance of what a Fit has, in its order and units: zero where the closed loop says nothing.
  [[nodiscard]] Eigen::MatrixXd as_of_fit(const Eigen::MatrixXd& covariance) const;

 private:
  const Fitter& fitter_;
  const Candidate& start_;
};

}  // namespace feedtwin::tools::diagnosis

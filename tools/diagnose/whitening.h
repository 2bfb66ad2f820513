#pragma once
// The residual's own colour, taken off it and off every regressor: an autoregression an equation, pooled over the runs.
// Rows about reversals and rests have a standard deviation of their own, so that what pre-sliding laws leave there
// does not pass for an effect.

#include <Eigen/Core>
#include <vector>

#include "tools/diagnose/inverse_model.h"
#include "tools/identify/whitening.h"

namespace feedtwin::tools::diagnosis {

class Whitening {
 public:
  /// Yule-Walker on the residual with its bursts clipped, so that they don't set its colour.
  static Whitening estimate(const InverseModel& model, const Vector& residual);

  /// In place: the innovations in units of their standard deviation.
  void apply(const InverseModel& model, Eigen::Ref<Eigen::MatrixXd> columns) const;
  [[nodiscard]] Vector applied(const InverseModel& model, const Vector& column) const;
  /// Standard deviation of an equation's residual where the axis has settled, bursts clipped, in its own unit.
  [[nodiscard]] double residual_rms(std::size_t equation) const { return rms_[equation]; }

 private:
  std::vector<tools::Whitening> colours_;
  std::vector<double> rms_;
  std::vector<double> unsettled_;  ///< weight of the rows about reversals and rests, where any friction law simplifies
};

}  // namespace feedtwin::tools::diagnosis

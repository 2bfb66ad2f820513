#pragma once
// A hypothesis of one shape against what a model leaves over, whitened: what it would explain with the model's own numbers
// free, and what it would explain by chance on surrogates of that residual.

#include <Eigen/Cholesky>
#include <vector>

#include "tools/diagnose/screen.h"

namespace feedtwin::tools::diagnosis {

inline constexpr Index surrogates = 199;

struct Task {
  const Hypothesis* hypothesis;
  const std::vector<double>* shape;
  double reach;    ///< of the step that its columns are taken over
  bool by_chance;  ///< its gains on surrogates are asked for too
};

/// What it does to the residual for each of its amplitudes, and what they are by least squares.
struct Columns {
  Eigen::MatrixXd white, on_q;  ///< all rows; along the numbers' directions, over the rows that it touches
  Eigen::MatrixXd gram;         ///< what the numbers cannot do
  Eigen::LDLT<Eigen::MatrixXd> solver;
  Vector amplitude;
  double touched = 0.0;  ///< squares of the residual's rows that it touches
  bool any = false;
};

class Asking {
 public:
  /// @param fitter, fit, whitening must outlive this
  Asking(const Fitter& fitter, const Fit& fit, const Whitening& whitening);

  /// What is left over that the model's own numbers cannot do; the prior's rows last.
  [[nodiscard]] const Vector& left() const { return left_; }
  [[nodiscard]] Columns columns_of(const Task& task) const;
  [[nodiscard]] Score score_of(const Task& task, const Columns& columns) const;
  /// What is left of each row without what such a hypothesis explains.
  [[nodiscard]] Vector without(const Columns& columns) const;
  /// Gains on surrogates of a residual: blocks whose signs are drawn at random.
  [[nodiscard]] Eigen::RowVectorXd by_chance(const Columns& columns, const Vector& residual) const;

 private:
  [[nodiscard]] Vector fall_of(const Active& more) const;

  const InverseModel& model_;
  const Fit& fit_;
  const Whitening& whitening_;
  const Eigen::MatrixXd q_;  ///< directions of the model's own numbers
  const Vector left_;
  const InverseModel::Standing standing_;
  const std::vector<Segment> blocks_;
  const Eigen::MatrixXd signs_;
};

}  // namespace feedtwin::tools::diagnosis

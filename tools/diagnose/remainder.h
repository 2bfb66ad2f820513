#pragma once
// What a model leaves over of the force, moment by moment, with where the axis was.

#include <vector>

#include "tools/diagnose/fit.h"

namespace feedtwin::tools::diagnosis {

/// Rows while the axis moves.
struct Remainder {
  std::vector<double> force_N, position_m, velocity_m_per_s, acceleration_m_per_s2, since_reversal_s;
  std::vector<std::size_t> fold;  ///< the run; of a single run, seconds in turn
  std::size_t folds = 0;

  [[nodiscard]] std::size_t size() const { return force_N.size(); }
  /// The rows of this fold, or all others.
  [[nodiscard]] Remainder part(std::size_t which, bool of_it) const;
};

enum class Forces { all, of_the_table };
/// Sum of the force equations' residuals, or that of the table's own, behind a force sensor; without one, nothing.
[[nodiscard]] Remainder remainder_of(const InverseModel& model, const Candidate& at, Forces which);

/// Takes off what the numbers could do of the rows to learn from, and as much of others.
void take_off_numbers(Remainder& rows, Remainder* others = nullptr);

}  // namespace feedtwin::tools::diagnosis

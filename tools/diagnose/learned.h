#pragma once
// What no hypothesis explains: does it repeat over position, speed or time since reversal, and with what force? A table
// learned on the runs to learn from and judged on others, so that a disturbance that never comes back teaches nothing.

#include <vector>

#include "tools/diagnose/fit.h"

namespace feedtwin::tools::diagnosis {

struct Learned {
  Where axis = Where::position;
  std::vector<double> points, force_pos_N, force_neg_N;  ///< against positive motion
  double share_held_out = 0.0;                           ///< of the remainder on runs that it was not learned from
  double remainder_N = 0.0;                              ///< RMS of the remainder there
  double low = 0.0, high = 0.0;                          ///< where most of it acts
};

/// The axis that explains most; `others` are the held-out runs.
/// @param of_others the model as it is for the others: their lines may have phases of their own
[[nodiscard]] Learned learn_remainder(const InverseModel& model, const Candidate& at, const InverseModel& others,
                                      const Candidate& of_others);

/// The plant's own term for it.
void extend(plant::AxisParameters& axis, const Learned& learned);

}  // namespace feedtwin::tools::diagnosis

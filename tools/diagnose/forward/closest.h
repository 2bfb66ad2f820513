#pragma once
// Which of several models the closed loop bears out.

#include "tools/diagnose/forward/forward_model.h"

namespace feedtwin::tools::diagnosis {

/// Mean logarithm of the closed loop's error on the runs, all channels alike.
[[nodiscard]] double far_off(const ForwardModel& forward, const AxisByRun& axis);

/// Which axis's closed loop comes closest to the runs, all channels alike; the first where none is clearly closer.
[[nodiscard]] std::size_t closest(const ForwardModel& forward, const std::vector<AxisByRun>& axes);

/// What its numbers alone can do, by the same measure as a named model: or the gain would be the polishing's.
[[nodiscard]] Candidate polished_if_closer(const ForwardModel& forward, const Fitter& fitter, const Candidate& start);

}  // namespace feedtwin::tools::diagnosis

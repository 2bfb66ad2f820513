#pragma once
// Where the mismatch lives, before and after, on runs that were not fitted: what the closed-loop simulation leaves over,
// against position, speed, time since reversal and time, and against what each named effect depends on.

#include "tools/diagnose/diagnosis.h"
#include "tools/diagnose/forward/forward_model.h"
#include "tools/report/figure.h"

namespace feedtwin::tools::diagnosis {

/// The axes whose remainders are shown beside each other.
struct Stages {
  AxisByRun nominal, recalibrated, updated;
};

/// @param tracks of the same runs, for speed and reversals
[[nodiscard]] std::vector<Figure> pictures(const ForwardModel& forward, const std::vector<Track>& tracks,
                                           const Stages& stages, const std::vector<NamedEffect>& named);

}  // namespace feedtwin::tools::diagnosis

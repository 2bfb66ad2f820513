#pragma once
// A linear scale that is read late: it differs from the encoder by the speed times the delay, whatever the force. A screw
// that yields does so by the force, a gap by the direction, a wrong lead by the place.

#include <optional>
#include <vector>

#include "tools/recording/case.h"

namespace feedtwin::tools::diagnosis {

struct LateScale {
  double delay_s = 0.0, deviation_s = 0.0;
};

/// By the runs to learn from; none where it is as late as samples are, or where something else moves it more.
[[nodiscard]] std::optional<LateScale> late_scale(const std::vector<Recording>& runs);

/// What the scale showed later, at its own time.
void bring_forward(Recording& run, const LateScale& late);

}  // namespace feedtwin::tools::diagnosis

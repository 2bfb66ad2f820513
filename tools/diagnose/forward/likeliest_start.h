#pragma once
// Numbers that only the closed loop tells start from the grid. Where that is far off, polishing does not arrive: flanks of
// 1e9 N/m that bounced through a whole run made a gap 34000 nats less likely than a screw that yields, and with the damping
// that they had 5700 nats likelier.

#include "tools/diagnose/forward/forward_model.h"

namespace feedtwin::tools::diagnosis {

/// The model with each such number at the likeliest of a few starts, all else as it is.
[[nodiscard]] Candidate at_likeliest_start(const ForwardModel& forward, Candidate model);

}  // namespace feedtwin::tools::diagnosis

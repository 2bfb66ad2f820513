#pragma once
// A part that rings, as the plant runs it.

#include "tools/diagnose/forward/forward_model.h"
#include "tools/diagnose/learned.h"

namespace feedtwin::tools::diagnosis {

/// The model as the closed loop has its numbers, with learned.mode as a part of the axis where that brings the runs of the
/// fit closer, and the mode's numbers as those runs have them. Where it does not, learned.mode is none.
[[nodiscard]] plant::AxisParameters with_mode(const ForwardModel& forward, const Fitter& fitter, const Candidate& told,
                                              Learned& learned);

}  // namespace feedtwin::tools::diagnosis

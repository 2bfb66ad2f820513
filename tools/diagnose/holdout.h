#pragma once
// Figures on runs that were not fitted, before and after.

#include "tools/diagnose/diagnosis.h"
#include "tools/diagnose/forward/forward_model.h"

namespace feedtwin::tools::diagnosis {

/// By the inverse model, through its low pass.
[[nodiscard]] std::map<std::string, ChannelFigures> figures(const Followed& nominal, const Followed& recalibrated_only,
                                                            const Followed& final);

/// The inverse model's relative force error; no floor.
[[nodiscard]] ChannelFigures force_errors(const Followed& nominal, const Followed& recalibrated_only, const Followed& final);

/// By closed-loop simulation.
[[nodiscard]] std::map<std::string, ChannelFigures> figures(const ForwardModel& runs, const AxisByRun& nominal,
                                                            const AxisByRun& recalibrated_only, const AxisByRun& final);

}  // namespace feedtwin::tools::diagnosis

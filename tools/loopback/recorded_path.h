#pragma once
// A recording as a motion to follow: its reference, for the controller that it was recorded under, or the motion itself with
// the command that made it, for a stand-in.

#include <memory>

#include "controllers/recorded.h"
#include "tools/recording/recording.h"

namespace feedtwin::tools {

/// Ticks over which a stand-in's speed is the mean (tracking_gains.h): the encoder's grid shows less.
inline constexpr int stand_in_window_samples = 4;

/// What the axis was asked to do; the recording holds reference_m.
[[nodiscard]] std::shared_ptr<const controllers::RecordedPath> recorded_reference(const Recording& recording);

/// What the axis did, with the command that made it. @param lead_m of the axis, for the command's force at the table
[[nodiscard]] std::shared_ptr<const controllers::RecordedPath> recorded_motion_path(const Recording& recording,
                                                                                    double lead_m);

}  // namespace feedtwin::tools

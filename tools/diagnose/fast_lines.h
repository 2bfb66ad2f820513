#pragma once
// How the runs of a case are to be read. Teeth may pass faster than the usual rows show: those are then closer.

#include <functional>
#include <string_view>

#include "tools/diagnose/track.h"
#include "tools/recording/case.h"

namespace feedtwin::tools::diagnosis {

/// How much of a jump of the command the force sensor shows, and samples a row: the usual number, or fewer where a sharp
/// line stands above what rows so far apart hold, at one frequency in every run.
[[nodiscard]] TrackSettings track_settings(const Case& data, const std::function<void(std::string_view)>& progress);

}  // namespace feedtwin::tools::diagnosis

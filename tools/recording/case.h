#pragma once
// A case: recordings of one axis, its nominal parameters, and what commanded it.

#include <optional>
#include <string>
#include <vector>

#include "controllers/cascade.h"
#include "plant/parameters.h"
#include "tools/recording/recording.h"

namespace feedtwin::tools {

struct Case {
  std::string folder;  ///< that case.toml stands in
  std::string file;    ///< case.toml itself, for messages
  plant::AxisParameters axis;
  double sample_rate_Hz = 1000.0;
  std::vector<Recording> fit;      ///< what a tool may learn from
  std::vector<Recording> holdout;  ///< only for figures before and after
  /// [controller]; without it a stand-in that tracks the recorded motion takes its place.
  std::optional<controllers::CascadeGains> controller;
  std::vector<std::string> remarks;  ///< what one should know about the recordings
};

/// @param path the folder or its case.toml. Recordings are checked (checks.h) and each holds torque_cmd_Nm and position_m:
/// made from force_cmd_N and scale_position_m where those are all there is. Throws InputError.
[[nodiscard]] Case read_case(const std::string& path);

}  // namespace feedtwin::tools

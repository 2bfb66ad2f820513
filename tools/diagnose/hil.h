#pragma once
// The loop closed: the real-time server follows a held-out recording's motion on the free-running clock, once with the
// nominal axis and once with the updated one, and what it logs is compared with the recording.

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "plant/parameters.h"
#include "tools/recording/case.h"

namespace feedtwin::tools::diagnosis {

struct HilRun {
  std::map<std::string, double, std::less<>>
      nrmse;             ///< |y - s| / |y - mean y|; the scale's as what it shows beyond the encoder
  double delay_s = 0.0;  ///< by which the server's motion came after the recorded one; taken out
  std::uint64_t ticks = 0, missed_ticks = 0;
  std::string verdict;
};

struct HilComparison {
  std::string recording;  ///< its file
  double duration_s = 0.0;
  HilRun before, after;  ///< nominal axis, updated axis
};

struct HilRequest {
  const Case& data;
  plant::AxisParameters nominal, updated;
  double duration_s = 0.0;  ///< 0: the whole recording
};

/// Takes twice the duration. The case's controller commands where it is known, else the recorded command
/// does, with a stand-in that brings the axis back to the recorded motion, the same in both runs. Throws InputError where no
/// run is held out.
[[nodiscard]] HilComparison run_hil(const HilRequest& request, const std::function<void(std::string_view)>& progress);

}  // namespace feedtwin::tools::diagnosis

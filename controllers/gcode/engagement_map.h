#pragma once
// Where a program's tool meets material, worked out once along the programmed path, so that a tick only looks it up.

#include <cstddef>
#include <vector>

#include "controllers/gcode/trajectory.h"
#include "plant/machine/engagement.h"
#include "plant/machine/workpiece.h"
#include "plant/realtime.h"

namespace feedtwin::controllers::gcode {

class EngagementMap {
 public:
  EngagementMap() = default;
  EngagementMap(const Trajectory& trajectory, const plant::BlockParameters& block, double tool_radius_m);

  /// Wait-free.
  [[nodiscard]] const plant::Engagement& at(std::size_t segment, double along_m) const noexcept FEEDTWIN_REALTIME;

  /// Volume that the path clears while it feeds, and the time that takes at the programmed feed.
  [[nodiscard]] double volume_m3() const noexcept { return volume_m3_; }
  [[nodiscard]] double cutting_time_s() const noexcept { return cutting_time_s_; }
  /// Mean removal rate of the cut as programmed; 0 where nothing is cut.
  [[nodiscard]] double removal_rate_m3_per_s() const noexcept {
    return cutting_time_s_ > 0.0 ? volume_m3_ / cutting_time_s_ : 0.0;
  }

 private:
  struct Stretch {
    std::size_t first = 0, count = 0;
    double step_m = 1.0;
  };
  std::vector<Stretch> stretches_;  // one a segment
  std::vector<plant::Engagement> engagements_;
  plant::Engagement none_;
  double volume_m3_ = 0.0, cutting_time_s_ = 0.0;
};

}  // namespace feedtwin::controllers::gcode

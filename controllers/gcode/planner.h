#pragma once
// The interpolator's look-ahead: from canonical commands to a trajectory within the axes' limits of speed, acceleration and
// jerk. The whole program is looked ahead over; a move stops only where the path mode or a switching command asks for it.

#include "controllers/gcode/canonical.h"
#include "controllers/gcode/trajectory.h"

namespace feedtwin::controllers::gcode {

struct PlannerSettings {
  Point start_m;
  AxisLimits limits;
  double blend_tolerance_m = 5e-6;  ///< in force at the start and after a G64 without P
  double feed_override = 1.0;       ///< on feed moves
};

/// G61 rounds within this: what no axis can show.
inline constexpr double exact_path_tolerance_m = 1e-9;

[[nodiscard]] Trajectory plan(const Program& program, const PlannerSettings& settings);

}  // namespace feedtwin::controllers::gcode

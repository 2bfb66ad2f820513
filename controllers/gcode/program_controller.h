#pragma once
// The machine's controller running a program: interpolator, one cascade an axis, spindle and pump. Off line and in real time
// the same step.

#include <cstddef>

#include "controllers/cascade.h"
#include "controllers/gcode/engagement_map.h"
#include "controllers/gcode/trajectory.h"
#include "plant/machine/machine.h"
#include "plant/realtime.h"

namespace feedtwin::controllers::gcode {

class ProgramController {
 public:
  /// @param speed_override on the spindle's commanded speed
  ProgramController(Trajectory trajectory, EngagementMap engagement, const CascadeGains& x, const CascadeGains& y,
                    double speed_override);

  /// The command for the next tick from the positions that the encoders show. Wait-free.
  const plant::MachineCommand& step(double x_m, double y_m, double tick_s) noexcept FEEDTWIN_REALTIME;

  [[nodiscard]] double time_s() const noexcept { return time_s_; }
  [[nodiscard]] bool finished() const noexcept { return time_s_ >= trajectory_.duration_s(); }
  /// What was asked for at the last step.
  [[nodiscard]] const Setpoint& setpoint() const noexcept { return setpoint_; }
  [[nodiscard]] const Trajectory& trajectory() const noexcept { return trajectory_; }
  [[nodiscard]] const EngagementMap& engagement() const noexcept { return engagement_; }
  /// Distance of a position from the programmed path. Wait-free.
  [[nodiscard]] double contour_error_m(double x_m, double y_m) const noexcept FEEDTWIN_REALTIME;

 private:
  void switch_on_time() noexcept;

  Trajectory trajectory_;
  EngagementMap engagement_;
  Cascade x_, y_;
  double speed_override_;
  Trajectory::Cursor cursor_;
  std::size_t next_event_ = 0;
  bool started_ = false;
  double time_s_ = 0.0;
  Setpoint setpoint_;
  plant::MachineCommand command_;
};

}  // namespace feedtwin::controllers::gcode

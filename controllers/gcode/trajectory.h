#pragma once
// A planned program: where the machine should be at every instant, and what it switches when.

#include <cstddef>
#include <vector>

#include "controllers/gcode/canonical.h"
#include "controllers/gcode/corner_blend.h"
#include "controllers/gcode/segment.h"
#include "controllers/speed_profile.h"
#include "plant/realtime.h"

namespace feedtwin::controllers::gcode {

/// What the machine is asked to do at an instant.
struct Setpoint {
  Point at_m, velocity_m_per_s, acceleration_m_per_s2;
  std::size_t segment = 0;  ///< of Trajectory::segments(): where on the programmed path
  double along_m = 0.0;     ///< from that segment's start
  bool moving = false;
};

/// A switching command at an instant.
struct SwitchingEvent {
  double time_s = 0.0;
  std::size_t line = 0;
  Action action;
};

class Trajectory {
 public:
  /// Where reading stands: time only goes forward.
  struct Cursor {
    std::size_t piece = 0;
  };

  [[nodiscard]] double duration_s() const noexcept { return duration_s_; }
  /// Wait-free; its cost is that of the pieces passed since the cursor's last reading.
  [[nodiscard]] Setpoint at(double time_s, Cursor& cursor) const noexcept FEEDTWIN_REALTIME;
  [[nodiscard]] const std::vector<Segment>& segments() const noexcept { return segments_; }
  [[nodiscard]] const std::vector<SwitchingEvent>& events() const noexcept { return events_; }
  [[nodiscard]] double largest_blend_deviation_m() const noexcept { return largest_blend_deviation_m_; }

 private:
  friend class Planner;
  struct Piece {
    double start_s = 0.0, duration_s = 0.0;
    std::size_t segment = 0;
    double from_m = 0.0;  // along the segment
    SpeedProfile profile;
    int blend = -1;  // index of blends_, which joins this segment with the next one
    double blend_speed_m_per_s = 0.0;
  };

  std::vector<Segment> segments_;
  std::vector<Piece> pieces_;
  std::vector<CornerBlend> blends_;
  std::vector<SwitchingEvent> events_;
  Point start_m_, end_m_;
  double duration_s_ = 0.0;
  double largest_blend_deviation_m_ = 0.0;
};

}  // namespace feedtwin::controllers::gcode

#pragma once
// One straight or circular move as a curve over its length s.

#include <cstddef>

#include "controllers/gcode/canonical.h"
#include "controllers/speed_profile.h"
#include "plant/realtime.h"

namespace feedtwin::controllers::gcode {

/// What each axis of the machine may do.
struct AxisLimits {
  Point speed_m_per_s{0.1, 0.1, 0.05};
  Point acceleration_m_per_s2{2.0, 2.0, 2.0};
  Point jerk_m_per_s3{100.0, 100.0, 100.0};
};

/// A curve and its derivatives by the length.
struct CurvePoint {
  Point at_m, first, second_per_m;
};

class Segment {
 public:
  static Segment straight(const Point& from_m, const Point& to_m) noexcept;
  /// Circle or helix. What the end is off the circle through the start (a tolerated spiral) is spread evenly over the
  /// length.
  static Segment arc(const Point& from_m, const ArcFeed& arc) noexcept;

  [[nodiscard]] double length_m() const noexcept { return length_m_; }
  [[nodiscard]] CurvePoint at(double s_m) const noexcept FEEDTWIN_REALTIME;
  [[nodiscard]] const Point& from_m() const noexcept { return from_m_; }
  [[nodiscard]] const Point& to_m() const noexcept { return to_m_; }
  [[nodiscard]] bool is_arc() const noexcept { return is_arc_; }
  [[nodiscard]] double radius_m() const noexcept { return radius_m_; }
  [[nodiscard]] const Point& centre_m() const noexcept { return centre_m_; }
  [[nodiscard]] int axis() const noexcept { return axis_; }
  [[nodiscard]] double sweep_rad() const noexcept { return sweep_rad_; }
  [[nodiscard]] double start_angle_rad() const noexcept { return start_rad_; }

  /// Limits along the path at a wanted speed, such that no axis leaves its own.
  [[nodiscard]] MoveLimits limits(double speed_m_per_s, const AxisLimits& axes) const noexcept;

  std::size_t line = 0;  ///< of the program
  bool rapid = false;
  double feed_m_per_s = 0.0;  ///< as programmed; 0 for a rapid

 private:
  [[nodiscard]] MoveLimits straight_limits(double speed_m_per_s, const AxisLimits& axes) const noexcept;
  [[nodiscard]] MoveLimits arc_limits(double speed_m_per_s, const AxisLimits& axes) const noexcept;

  Point from_m_, to_m_;
  double length_m_ = 0.0;
  bool is_arc_ = false;
  Point drift_;  // per length: the direction of a straight move; rise along the axis and spiral of an arc
  Point centre_m_;
  int axis_ = 2;
  double radius_m_ = 0.0, start_rad_ = 0.0, sweep_rad_ = 0.0;
};

}  // namespace feedtwin::controllers::gcode

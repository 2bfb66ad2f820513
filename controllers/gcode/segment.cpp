#include "controllers/gcode/segment.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::controllers::gcode {
namespace {

// Shares of an axis' limits on an arc. Acceleration: tangential 0.6, centripetal 0.8, at right angles. Jerk: tangential 0.4
// and the centripetal acceleration's turning 0.2 along the tangent, growth of the centripetal acceleration 0.8 across it.
constexpr double tangential_acceleration = 0.6, centripetal_acceleration = 0.8;
constexpr double tangential_jerk = 0.4, turning_jerk = 0.2, centripetal_jerk = 0.8;

}  // namespace

Segment Segment::straight(const Point& from_m, const Point& to_m) noexcept {
  Segment s;
  s.from_m_ = from_m;
  s.to_m_ = to_m;
  s.length_m_ = gcode::length(to_m - from_m);
  if (s.length_m_ > 0.0) s.drift_ = (1.0 / s.length_m_) * (to_m - from_m);
  return s;
}

Segment Segment::arc(const Point& from_m, const ArcFeed& arc) noexcept {
  Segment s;
  const int first = (arc.axis + 1) % 3, second = (arc.axis + 2) % 3;
  s.is_arc_ = true;
  s.from_m_ = from_m;
  s.to_m_ = arc.to_m;
  s.centre_m_ = arc.centre_m;
  s.axis_ = arc.axis;
  s.centre_m_[arc.axis] = from_m[arc.axis];
  s.sweep_rad_ = arc.sweep_rad;
  s.radius_m_ = std::hypot(from_m[first] - arc.centre_m[first], from_m[second] - arc.centre_m[second]);
  s.start_rad_ = std::atan2(from_m[second] - arc.centre_m[second], from_m[first] - arc.centre_m[first]);
  s.length_m_ = std::hypot(s.radius_m_ * arc.sweep_rad, arc.to_m[arc.axis] - from_m[arc.axis]);
  if (s.length_m_ > 0.0) {
    const Point end = s.at(s.length_m_).at_m;  // without drift yet
    s.drift_ = (1.0 / s.length_m_) * (arc.to_m - end);
  }
  return s;
}

CurvePoint Segment::at(double s_m) const noexcept FEEDTWIN_REALTIME {
  if (!is_arc_) return {from_m_ + s_m * drift_, drift_, {}};
  const int first = (axis_ + 1) % 3, second = (axis_ + 2) % 3;
  const double turn = sweep_rad_ / length_m_;
  const double angle = start_rad_ + turn * s_m;
  const double c = radius_m_ * std::cos(angle), s = radius_m_ * std::sin(angle);
  CurvePoint p{centre_m_ + s_m * drift_, drift_, {}};
  p.at_m[first] += c;
  p.at_m[second] += s;
  p.first[first] -= turn * s;
  p.first[second] += turn * c;
  p.second_per_m[first] = -turn * turn * c;
  p.second_per_m[second] = -turn * turn * s;
  return p;
}

MoveLimits Segment::limits(double speed_m_per_s, const AxisLimits& axes) const noexcept {
  return is_arc_ ? arc_limits(speed_m_per_s, axes) : straight_limits(speed_m_per_s, axes);
}

MoveLimits Segment::straight_limits(double speed_m_per_s, const AxisLimits& axes) const noexcept {
  MoveLimits limits{speed_m_per_s, 1e9, 1e12};
  for (int i = 0; i < 3; ++i) {
    const double share = std::abs(drift_[i]);
    if (share == 0.0) continue;
    limits.speed_m_per_s = std::min(limits.speed_m_per_s, axes.speed_m_per_s[i] / share);
    limits.acceleration_m_per_s2 = std::min(limits.acceleration_m_per_s2, axes.acceleration_m_per_s2[i] / share);
    limits.jerk_m_per_s3 = std::min(limits.jerk_m_per_s3, axes.jerk_m_per_s3[i] / share);
  }
  return limits;
}

// With u the speed in the plane, r the radius:  a = u' T + u^2/r N,   j = (u'' - u^3/r^2) T + 3 u u'/r N.
MoveLimits Segment::arc_limits(double speed_m_per_s, const AxisLimits& axes) const noexcept {
  const int first = (axis_ + 1) % 3, second = (axis_ + 2) % 3;
  const double planar = radius_m_ * std::abs(sweep_rad_) / length_m_;            // u = planar * v
  const double tangential = planar + std::hypot(drift_[first], drift_[second]);  // with the spiral's share
  const double rise = std::abs(drift_[axis_]);
  const double V = std::min(axes.speed_m_per_s[first], axes.speed_m_per_s[second]);
  const double A = std::min(axes.acceleration_m_per_s2[first], axes.acceleration_m_per_s2[second]);
  const double J = std::min(axes.jerk_m_per_s3[first], axes.jerk_m_per_s3[second]);
  const double u =
      std::min(std::sqrt(centripetal_acceleration * A * radius_m_), std::cbrt(turning_jerk * J * radius_m_ * radius_m_));
  MoveLimits limits{std::min({speed_m_per_s, V / tangential, u / planar}), tangential_acceleration * A / tangential,
                    tangential_jerk * J / tangential};
  limits.acceleration_m_per_s2 = std::min(limits.acceleration_m_per_s2,
                                          centripetal_jerk * J * radius_m_ / (3.0 * planar * planar * limits.speed_m_per_s));
  if (rise > 0.0) {
    limits.speed_m_per_s = std::min(limits.speed_m_per_s, axes.speed_m_per_s[axis_] / rise);
    limits.acceleration_m_per_s2 = std::min(limits.acceleration_m_per_s2, axes.acceleration_m_per_s2[axis_] / rise);
    limits.jerk_m_per_s3 = std::min(limits.jerk_m_per_s3, axes.jerk_m_per_s3[axis_] / rise);
  }
  return limits;
}

}  // namespace feedtwin::controllers::gcode

#pragma once
// A corner rounded within a tolerance: a quintic in time that joins two segments in position, velocity and acceleration.
//
// It leaves the first segment a length l before the corner and enters the second l after it, at the same speed v with no
// tangential acceleration: p' = v dp/ds, p'' = v^2 d2p/ds2 at both ends. Over u = t v / (2 l) its shape does not depend on
// v, so that velocity, acceleration and jerk scale with v, v^2 and v^3, and the highest v within the axes' limits follows.
// (Quintic corner transitions: K. Erkorkmaz, Y. Altintas, Int. J. Mach. Tools Manuf. 41 (2001) 1323.)

#include <array>

#include "controllers/gcode/segment.h"
#include "plant/realtime.h"

namespace feedtwin::controllers::gcode {

class CornerBlend {
 public:
  CornerBlend() = default;
  /// @param cut_m what is cut off both segments, > 0
  CornerBlend(const Segment& before, const Segment& after, double cut_m) noexcept;

  [[nodiscard]] double cut_m() const noexcept { return cut_m_; }
  /// How far from the programmed path it runs at most; never less than the true distance.
  [[nodiscard]] double deviation_m(const Segment& before, const Segment& after) const noexcept;
  /// The highest speed at its ends that keeps every axis within its limits all along.
  [[nodiscard]] double speed_limit_m_per_s(const AxisLimits& axes) const noexcept;
  [[nodiscard]] double duration_s(double speed_m_per_s) const noexcept { return 2.0 * cut_m_ / speed_m_per_s; }

  struct Sample {
    Point at_m, velocity_m_per_s, acceleration_m_per_s2;
  };
  /// @param u from 0 to 1
  [[nodiscard]] Sample at(double u, double speed_m_per_s) const noexcept FEEDTWIN_REALTIME;

 private:
  std::array<std::array<double, 6>, 3> c_{};  // coefficients by axis, of powers of u
  double cut_m_ = 0.0;
};

/// The largest blend whose deviation is within the tolerance; cut_m() is 0 where there is none.
[[nodiscard]] CornerBlend blend_within(const Segment& before, const Segment& after, double tolerance_m) noexcept;

}  // namespace feedtwin::controllers::gcode

#pragma once
// Speed over a stretch of path within limits of speed, acceleration and jerk: from one speed up to a highest one, along at
// it, down to another speed. Acceleration is zero at both ends and while cruising, so stretches join without a jump.

#include "controllers/reference.h"
#include "plant/realtime.h"

namespace feedtwin::controllers {

struct MoveLimits {
  double speed_m_per_s, acceleration_m_per_s2, jerk_m_per_s3;  ///< each > 0
};

/// A change of speed at limited jerk, as fast as possible: jerk, constant acceleration (or none), jerk.
class SpeedRamp {
 public:
  SpeedRamp() = default;
  SpeedRamp(double from_m_per_s, double to_m_per_s, const MoveLimits& limits) noexcept;
  [[nodiscard]] double duration_s() const noexcept { return 2.0 * jerk_s_ + hold_s_; }
  [[nodiscard]] double distance_m() const noexcept { return 0.5 * (from_ + to_) * duration_s(); }
  [[nodiscard]] Reference at(double time_s) const noexcept FEEDTWIN_REALTIME;

 private:
  double from_ = 0.0, to_ = 0.0, jerk_ = 0.0;  // jerk_ with the sign of the change
  double jerk_s_ = 0.0, hold_s_ = 0.0;
};

/// The highest speed up to `limits.speed_m_per_s` from which (or to which) a ramp to `other` fits into the distance.
[[nodiscard]] double reachable_speed_m_per_s(double other_m_per_s, double distance_m, const MoveLimits& limits) noexcept;

class SpeedProfile {
 public:
  SpeedProfile() = default;
  /// Both end speeds must be within the limit and a ramp between them must fit into the distance.
  SpeedProfile(double from_m_per_s, double to_m_per_s, double distance_m, const MoveLimits& limits) noexcept;
  [[nodiscard]] double duration_s() const noexcept { return rise_.duration_s() + cruise_s_ + fall_.duration_s(); }
  /// Position counts from the start of the stretch. Wait-free.
  [[nodiscard]] Reference at(double time_s) const noexcept FEEDTWIN_REALTIME;

 private:
  SpeedRamp rise_, fall_;
  double cruise_s_ = 0.0, speed_ = 0.0, distance_m_ = 0.0, last_speed_ = 0.0;
};

}  // namespace feedtwin::controllers

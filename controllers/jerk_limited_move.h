#pragma once
// A rest-to-rest move within limits of speed, acceleration and jerk: the seven-segment profile (S-curve).

#include <cmath>

#include "controllers/speed_profile.h"

namespace feedtwin::controllers {

class JerkLimitedMove {
 public:
  /// A move over `distance_m` (signed), as fast as the limits allow.
  JerkLimitedMove(double distance_m, const MoveLimits& limits) noexcept
      : direction_(distance_m < 0.0 ? -1.0 : 1.0), profile_(0.0, 0.0, std::abs(distance_m), limits) {}

  [[nodiscard]] double duration_s() const noexcept { return profile_.duration_s(); }
  /// Position counts from the start of the move. Wait-free.
  [[nodiscard]] Reference at(double time_s) const noexcept FEEDTWIN_REALTIME {
    if (time_s <= 0.0) return {};
    const Reference r = profile_.at(time_s);
    return {direction_ * r.position_m, direction_ * r.velocity_m_per_s, direction_ * r.acceleration_m_per_s2};
  }

 private:
  double direction_;
  SpeedProfile profile_;
};

}  // namespace feedtwin::controllers

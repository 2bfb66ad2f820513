#pragma once
// A rest-to-rest move within limits of speed, acceleration and jerk: the seven-segment profile (S-curve).

#include "controllers/reference.h"

namespace feedtwin::controllers {

struct MoveLimits {
  double speed_m_per_s, acceleration_m_per_s2, jerk_m_per_s3;  ///< each > 0
};

class JerkLimitedMove {
 public:
  /// A move over `distance_m` (signed), as fast as the limits allow.
  JerkLimitedMove(double distance_m, const MoveLimits& limits) noexcept;

  [[nodiscard]] double duration_s() const noexcept { return 2.0 * (2.0 * jerk_s_ + hold_s_) + cruise_s_; }
  /// Position counts from the start of the move. Wait-free.
  [[nodiscard]] Reference at(double time_s) const noexcept;

 private:
  [[nodiscard]] Reference rising(double time_s) const noexcept;  ///< the first three segments

  double direction_ = 1.0, distance_m_ = 0.0, jerk_ = 1.0;
  double jerk_s_ = 0.0, hold_s_ = 0.0, cruise_s_ = 0.0;  ///< length of a jerk phase, of constant acceleration, of cruise
};

}  // namespace feedtwin::controllers

#include "controllers/jerk_limited_move.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::controllers {

JerkLimitedMove::JerkLimitedMove(double distance_m, const MoveLimits& limits) noexcept
    : direction_(distance_m < 0.0 ? -1.0 : 1.0), distance_m_(std::abs(distance_m)), jerk_(limits.jerk_m_per_s3) {
  const double j = limits.jerk_m_per_s3;
  // the largest speed that this distance leaves room for: first without, then with constant acceleration
  const double triangular = std::cbrt(0.25 * distance_m_ * distance_m_ * j);
  double speed = std::min(limits.speed_m_per_s, triangular);
  if (speed * j > limits.acceleration_m_per_s2 * limits.acceleration_m_per_s2) {
    const double a = limits.acceleration_m_per_s2;  // distance = v (v/a + a/j)
    const double reachable = 0.5 * (std::sqrt(a * a * a * a / (j * j) + 4.0 * a * distance_m_) - a * a / j);
    speed = std::min(limits.speed_m_per_s, reachable);
    jerk_s_ = a / j;
    hold_s_ = std::max(0.0, speed / a - jerk_s_);
  } else {
    jerk_s_ = std::sqrt(speed / j);
  }
  cruise_s_ = speed > 0.0 ? std::max(0.0, distance_m_ / speed - (2.0 * jerk_s_ + hold_s_)) : 0.0;
}

Reference JerkLimitedMove::rising(double time_s) const noexcept {
  const double peak = jerk_ * jerk_s_;
  const double t1 = std::min(time_s, jerk_s_);
  Reference r{jerk_ * t1 * t1 * t1 / 6.0, 0.5 * jerk_ * t1 * t1, jerk_ * t1};
  const double t2 = std::clamp(time_s - jerk_s_, 0.0, hold_s_);
  r.position_m += t2 * (r.velocity_m_per_s + 0.5 * peak * t2);
  r.velocity_m_per_s += peak * t2;
  const double t3 = std::clamp(time_s - jerk_s_ - hold_s_, 0.0, jerk_s_);
  if (t3 > 0.0) {
    r.position_m += t3 * (r.velocity_m_per_s + t3 * (0.5 * peak - jerk_ * t3 / 6.0));
    r.velocity_m_per_s += t3 * (peak - 0.5 * jerk_ * t3);
    r.acceleration_m_per_s2 = peak - jerk_ * t3;
  }
  return r;
}

Reference JerkLimitedMove::at(double time_s) const noexcept {
  const double ramp_s = 2.0 * jerk_s_ + hold_s_;
  if (time_s <= 0.0 || distance_m_ == 0.0) return {};
  if (time_s >= duration_s()) return {direction_ * distance_m_, 0.0, 0.0};
  Reference r;
  if (time_s < ramp_s) {
    r = rising(time_s);
  } else if (time_s <= ramp_s + cruise_s_) {
    r = rising(ramp_s);
    r.position_m += r.velocity_m_per_s * (time_s - ramp_s);
    r.acceleration_m_per_s2 = 0.0;
  } else {
    r = rising(duration_s() - time_s);  // the fall is the rise run backwards
    r.position_m = distance_m_ - r.position_m;
    r.acceleration_m_per_s2 = -r.acceleration_m_per_s2;
  }
  return {direction_ * r.position_m, direction_ * r.velocity_m_per_s, direction_ * r.acceleration_m_per_s2};
}

}  // namespace feedtwin::controllers

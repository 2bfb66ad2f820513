#include "controllers/speed_profile.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::controllers {
namespace {

/// Largest root of a rising function's complement: the highest x in [low, high] that still fits.
template <class Fits>
double highest_that_fits(double low, double high, Fits fits) noexcept {
  if (fits(high)) return high;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (fits(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace

SpeedRamp::SpeedRamp(double from_m_per_s, double to_m_per_s, const MoveLimits& limits) noexcept
    : from_(from_m_per_s), to_(to_m_per_s) {
  const double change = std::abs(to_ - from_);
  const double a = limits.acceleration_m_per_s2, j = limits.jerk_m_per_s3;
  if (change * j > a * a) {
    jerk_s_ = a / j;
    hold_s_ = change / a - jerk_s_;
  } else {
    jerk_s_ = std::sqrt(change / j);
  }
  jerk_ = to_ < from_ ? -j : j;
}

Reference SpeedRamp::at(double time_s) const noexcept FEEDTWIN_REALTIME {
  const double peak = jerk_ * jerk_s_;
  const double t1 = std::clamp(time_s, 0.0, jerk_s_);
  Reference r{t1 * (from_ + jerk_ * t1 * t1 / 6.0), from_ + 0.5 * jerk_ * t1 * t1, jerk_ * t1};
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

double reachable_speed_m_per_s(double other_m_per_s, double distance_m, const MoveLimits& limits) noexcept {
  return highest_that_fits(other_m_per_s, std::max(other_m_per_s, limits.speed_m_per_s),
                           [&](double speed) { return SpeedRamp(other_m_per_s, speed, limits).distance_m() <= distance_m; });
}

SpeedProfile::SpeedProfile(double from_m_per_s, double to_m_per_s, double distance_m, const MoveLimits& limits) noexcept
    : distance_m_(distance_m), last_speed_(to_m_per_s) {
  const double least = std::max(from_m_per_s, to_m_per_s);
  speed_ = highest_that_fits(least, std::max(least, limits.speed_m_per_s), [&](double speed) {
    return SpeedRamp(from_m_per_s, speed, limits).distance_m() + SpeedRamp(speed, to_m_per_s, limits).distance_m() <=
           distance_m;
  });
  rise_ = SpeedRamp(from_m_per_s, speed_, limits);
  fall_ = SpeedRamp(speed_, to_m_per_s, limits);
  const double rest_m = distance_m - rise_.distance_m() - fall_.distance_m();
  cruise_s_ = speed_ > 0.0 ? std::max(0.0, rest_m / speed_) : 0.0;
}

Reference SpeedProfile::at(double time_s) const noexcept FEEDTWIN_REALTIME {
  if (time_s >= duration_s()) return {distance_m_, last_speed_, 0.0};
  const double rise_s = rise_.duration_s();
  if (time_s < rise_s) return rise_.at(time_s);
  if (time_s < rise_s + cruise_s_) return {rise_.distance_m() + speed_ * (time_s - rise_s), speed_, 0.0};
  Reference r = fall_.at(time_s - rise_s - cruise_s_);
  r.position_m += distance_m_ - fall_.distance_m();
  return r;
}

}  // namespace feedtwin::controllers

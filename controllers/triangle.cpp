#include "controllers/triangle.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::controllers {
namespace {

/// Constant speed between -amplitude and +amplitude about the centre, turned round at constant acceleration, from rest at
/// the centre. Within a half period T/2 the velocity falls from +v to -v in 2 v / a.
class Triangle final : public Motion {
 public:
  explicit Triangle(const MotionSettings& s) : centre_m_(s.centre_m), acceleration_(s.acceleration_m_per_s2) {
    // the ramps must fit: a turn takes v^2 / (2 a) of the way to either side
    speed_ = std::min(s.speed_m_per_s, std::sqrt(s.amplitude_m * s.acceleration_m_per_s2));
    ramp_s_ = speed_ / acceleration_;
    start_lag_m_ = 0.5 * speed_ * ramp_s_;  // the first ramp, out of rest, falls behind by this much
    cruise_s_ = 2.0 * (s.amplitude_m - start_lag_m_) / speed_;
  }

  [[nodiscard]] Reference at(double time_s) const noexcept override {
    if (time_s <= 0.0) return {centre_m_, 0.0, 0.0};
    if (time_s < ramp_s_) return {centre_m_ + 0.5 * acceleration_ * time_s * time_s, acceleration_ * time_s, acceleration_};
    // from here on periodic: phase 0 is full speed at the near end of the cruise
    const double half_s = cruise_s_ + 2.0 * ramp_s_;
    const double since_s = time_s - ramp_s_ + 0.5 * cruise_s_ + start_lag_m_ / speed_;
    const double half_periods = std::floor(since_s / half_s);
    const double t = since_s - half_periods * half_s;
    const double direction = std::fmod(half_periods, 2.0) == 0.0 ? 1.0 : -1.0;
    const double reach_m = 0.5 * speed_ * cruise_s_;
    if (t < cruise_s_) return {centre_m_ + direction * (speed_ * t - reach_m), direction * speed_, 0.0};
    const double u = t - cruise_s_;
    return {centre_m_ + direction * (reach_m + u * (speed_ - 0.5 * acceleration_ * u)),
            direction * (speed_ - acceleration_ * u), -direction * acceleration_};
  }

 private:
  double centre_m_, acceleration_;
  double speed_ = 0.0, ramp_s_ = 0.0, start_lag_m_ = 0.0, cruise_s_ = 0.0;
};

}  // namespace

std::unique_ptr<Motion> make_triangle(const MotionSettings& settings) {
  return std::make_unique<Triangle>(settings);
}

}  // namespace feedtwin::controllers

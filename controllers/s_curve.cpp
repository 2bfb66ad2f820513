#include "controllers/s_curve.h"

#include <cmath>

#include "controllers/jerk_limited_move.h"

namespace feedtwin::controllers {
namespace {

/// From the centre to +amplitude, then to and fro between the ends, with a dwell after each move.
class SCurve final : public Motion {
 public:
  explicit SCurve(const MotionSettings& s)
      : centre_m_(s.centre_m),
        amplitude_m_(s.amplitude_m),
        dwell_s_(s.dwell_s),
        first_(s.amplitude_m, {s.speed_m_per_s, s.acceleration_m_per_s2, s.jerk_m_per_s3}),
        there_(2.0 * s.amplitude_m, {s.speed_m_per_s, s.acceleration_m_per_s2, s.jerk_m_per_s3}) {}

  [[nodiscard]] Reference at(double time_s) const noexcept override {
    const double first_s = first_.duration_s() + dwell_s_;
    Reference r;
    if (time_s < first_s) {
      r = first_.at(time_s);
    } else {
      const double move_s = there_.duration_s() + dwell_s_;
      const double moves = std::floor((time_s - first_s) / move_s);
      const double direction = std::fmod(moves, 2.0) == 0.0 ? -1.0 : 1.0;
      r = there_.at(time_s - first_s - moves * move_s);
      r = {direction * (r.position_m - amplitude_m_), direction * r.velocity_m_per_s, direction * r.acceleration_m_per_s2};
    }
    r.position_m += centre_m_;
    return r;
  }

 private:
  double centre_m_, amplitude_m_, dwell_s_;
  JerkLimitedMove first_, there_;
};

}  // namespace

std::unique_ptr<Motion> make_s_curve(const MotionSettings& settings) {
  return std::make_unique<SCurve>(settings);
}

}  // namespace feedtwin::controllers

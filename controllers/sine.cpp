#include "controllers/sine.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::controllers {
namespace {

/// x = centre + A e(t) sin(w t), w = v_max / A. e rises from 0 to 1 over the first period as the smooth step
/// 10 s^3 - 15 s^4 + 6 s^5, so that the motion starts at rest.
class Sine final : public Motion {
 public:
  explicit Sine(const MotionSettings& s)
      : centre_m_(s.centre_m), amplitude_m_(s.amplitude_m), rate_rad_per_s_(s.speed_m_per_s / s.amplitude_m) {}

  [[nodiscard]] Reference at(double time_s) const noexcept override {
    constexpr double period_rad = 6.283185307179586;
    const double phase = rate_rad_per_s_ * std::max(0.0, time_s);
    const double s = std::min(1.0, phase / period_rad);
    const double rate = rate_rad_per_s_ / period_rad;  // ds/dt while rising
    const bool rising = s < 1.0;
    const double e = s * s * s * (10.0 - s * (15.0 - 6.0 * s));
    const double de = rising ? 30.0 * s * s * (1.0 - s) * (1.0 - s) * rate : 0.0;
    const double dde = rising ? 60.0 * s * (1.0 - s) * (1.0 - 2.0 * s) * rate * rate : 0.0;
    const double sine = std::sin(phase);
    const double cosine = std::cos(phase);
    const double w = rate_rad_per_s_;
    return {centre_m_ + amplitude_m_ * e * sine, amplitude_m_ * (de * sine + e * w * cosine),
            amplitude_m_ * (dde * sine + 2.0 * de * w * cosine - e * w * w * sine)};
  }

 private:
  double centre_m_, amplitude_m_, rate_rad_per_s_;
};

}  // namespace

std::unique_ptr<Motion> make_sine(const MotionSettings& settings) {
  return std::make_unique<Sine>(settings);
}

}  // namespace feedtwin::controllers

#pragma once
// A sine over table travel or over time, as its exact mean over a sub-step.

#include <cmath>
#include <numbers>

#include "plant/effects/effect.h"

namespace feedtwin::plant {

/// mean of sin over [a - d, a + d] = sin(a) sin(d) / d; both are wait-free.
struct SineMean {
  double value, slope_by_half_width;
};
[[nodiscard]] inline SineMean sine_mean(double middle, double half_width) noexcept {
  const double s = std::sin(middle);
  if (std::abs(half_width) < 0.05) {  // to the fourth power: 1e-9
    const double d2 = half_width * half_width;
    return {s * (1.0 - d2 * (1.0 / 6.0 - d2 * (1.0 / 120.0))), s * half_width * (-1.0 / 3.0 + d2 * (1.0 / 30.0))};
  }
  const double sinc = std::sin(half_width) / half_width;
  return {s * sinc, s * (std::cos(half_width) - sinc) / half_width};
}

/// sin(n theta + phase), theta = 2 pi x / p_b the shaft's angle: n periods a revolution.
class RevolutionWave {
 public:
  /// @param lead_m p_b
  RevolutionWave(double lead_m, double cycles_per_rev, double phase_rad) noexcept
      : wave_rad_per_m_(2.0 * std::numbers::pi * cycles_per_rev / lead_m), phase_rad_(phase_rad) {}

  [[nodiscard]] double at(double position_m) const noexcept { return std::sin(wave_rad_per_m_ * position_m + phase_rad_); }

  /// Mean over a sub-step of `scale_N` times the wave, with its slope by the mean velocity.
  [[nodiscard]] EffectLoad mean_N(const EffectMotion& m, double scale_N) const noexcept {
    const double half_per_speed = 0.5 * wave_rad_per_m_ * m.h_s;
    const double half = half_per_speed * m.velocity_m_per_s;
    const double middle = wave_rad_per_m_ * m.position_m + phase_rad_ + half;
    const SineMean mean = sine_mean(middle, half);
    const double cosine_mean = std::cos(middle) * (half == 0.0 ? 1.0 : std::sin(half) / half);
    return {scale_N * mean.value, scale_N * half_per_speed * (cosine_mean + mean.slope_by_half_width)};
  }

 private:
  double wave_rad_per_m_, phase_rad_;
};

/// Mean of sin(2 pi f t + phase) from t to t + h.
[[nodiscard]] inline double time_sine_mean(double frequency_Hz, double phase_rad, double time_s, double h_s) noexcept {
  const double half = std::numbers::pi * frequency_Hz * h_s;
  return sine_mean(2.0 * std::numbers::pi * frequency_Hz * time_s + phase_rad + half, half).value;
}

inline constexpr double whole_turn_rad = 6.2831853071795864;

}  // namespace feedtwin::plant

#pragma once
// A sine over table travel or over time, as its exact mean over a sub-step.

#include <cmath>
#include <numbers>

#include "plant/effects/effect.h"

namespace feedtwin::plant {

/// sin(d) / d and its slope, d the half width of an interval: mean of sin over [a - d, a + d] = sin(a) sinc(d). Wait-free.
struct Sinc {
  double value, slope;
};
[[nodiscard]] inline Sinc sinc(double d) noexcept {
  if (std::abs(d) < 0.5) {  // the usual case; to 3e-11
    const double d2 = d * d;
    return {1.0 - d2 / 6.0 * (1.0 - d2 / 20.0 * (1.0 - d2 / 42.0 * (1.0 - d2 / 72.0))),
            -d / 3.0 * (1.0 - d2 / 10.0 * (1.0 - d2 / 28.0 * (1.0 - d2 / 54.0)))};
  }
  const double value = std::sin(d) / d;
  return {value, (std::cos(d) - value) / d};
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
    const Sinc narrowed = sinc(half);
    const double sine = std::sin(middle);
    const double cosine = std::cos(middle);
    return {scale_N * sine * narrowed.value, scale_N * half_per_speed * (cosine * narrowed.value + sine * narrowed.slope)};
  }

 private:
  double wave_rad_per_m_, phase_rad_;
};

/// A force A sin(2 pi f t + phase), t since the run began.
class TimeWave {
 public:
  TimeWave(double amplitude_N, double frequency_Hz, double phase_rad) noexcept
      : amplitude_N_(amplitude_N), frequency_Hz_(frequency_Hz), phase_rad_(phase_rad) {}

  /// Mean over a sub-step.
  [[nodiscard]] double mean_N(const EffectMotion& m) const noexcept {
    const double half = std::numbers::pi * frequency_Hz_ * m.h_s;
    return amplitude_N_ * std::sin(2.0 * std::numbers::pi * frequency_Hz_ * m.time_s + phase_rad_ + half) * sinc(half).value;
  }

 private:
  double amplitude_N_, frequency_Hz_, phase_rad_;
};

inline constexpr double whole_turn_rad = 6.2831853071795864;

}  // namespace feedtwin::plant

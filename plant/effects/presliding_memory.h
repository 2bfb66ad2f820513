#pragma once
// Pre-sliding with nonlocal memory: Maxwell-slip elements in parallel on the ball screw (Lampaert, Swevers, Al-Bender).
//
//   F = sum_i k e_i,   de_i/dx = 1 while |e_i| < d_i, else 0,   d_i = d (i - 1/2) / N,   k = 2 force_N / (N d)
//
// so that the virgin curve is force_N (2 x/d - (x/d)^2) up to d = distance_m and force_N beyond. The mean of an element over
// a path s is exact: e + s/2, or d_i - (d_i - e)^2 / (2 s) where it slips.

#include <algorithm>
#include <array>
#include <cmath>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class PreslidingMemory final : public Effect {
 public:
  static constexpr std::size_t elements = 8;

  PreslidingMemory(const EffectContext& /*context*/, const EffectSetting& setting)
      : stiffness_N_per_m_(2.0 * setting.values[0] / (static_cast<double>(elements) * setting.values[1])) {
    for (std::size_t i = 0; i < elements; ++i)
      slip_m_[i] = setting.values[1] * (static_cast<double>(i) + 0.5) / static_cast<double>(elements);
  }

  void reset(double /*position_m*/) noexcept override { deflection_m_ = {}; }

  [[nodiscard]] EffectLoad load(const EffectMotion& m) const noexcept override {
    const double path_m = m.velocity_m_per_s * m.h_s;
    const double forth = path_m < 0.0 ? -1.0 : 1.0;
    const double length_m = std::abs(path_m);
    double mean_m = 0.0;
    double slope = 0.0;
    for (std::size_t i = 0; i < elements; ++i) {
      const double e_m = forth * deflection_m_[i];
      const double room_m = slip_m_[i] - e_m;
      if (length_m <= room_m) {
        mean_m += e_m + 0.5 * length_m;
        slope += 0.5;
      } else {
        const double share = room_m / length_m;
        mean_m += slip_m_[i] - 0.5 * room_m * share;
        slope += 0.5 * share * share;
      }
    }
    return {forth * stiffness_N_per_m_ * mean_m, stiffness_N_per_m_ * slope * m.h_s};
  }

  void advance(const EffectMotion& m) noexcept override {
    const double path_m = m.velocity_m_per_s * m.h_s;
    for (std::size_t i = 0; i < elements; ++i)
      deflection_m_[i] = std::clamp(deflection_m_[i] + path_m, -slip_m_[i], slip_m_[i]);
  }

  [[nodiscard]] double stored_J() const noexcept override {
    double sum_m2 = 0.0;
    for (const double e_m : deflection_m_) sum_m2 += e_m * e_m;
    return 0.5 * stiffness_N_per_m_ * sum_m2;
  }

 private:
  double stiffness_N_per_m_;
  std::array<double, elements> slip_m_{}, deflection_m_{};
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array presliding_memory_parameters{
    EffectParameter{"force_N", "N", 0.0, 10000.0, {}, 0.0, "sum of the elements when all slip"},
    EffectParameter{"distance_m", "m", 1e-07, 0.001, {}, {}, "travel after a reversal from rest at which all slip (twice that from sliding)"},
};
// clang-format on

inline constexpr EffectEntry presliding_memory{
    .id = "presliding_memory",
    .component = EffectComponent::ball_screw,
    .work = EffectWork::dissipates,
    .meaning = "friction force follows the path since each past reversal over some micrometres before the contact slides",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm",
    .confused_with = "backlash dwell_breakaway screw_compliance",
    .exciting_move = "slow reversals of 1 to 50 um, nested in each other",
    .parameters = presliding_memory_parameters,
    .make = make_effect<PreslidingMemory>,
    .hooks = hooks_of<PreslidingMemory>(),
    .even_in_motion = true,
};

}  // namespace feedtwin::plant::effects

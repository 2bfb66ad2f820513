#pragma once
// A part of the machine on a light damper that the table carries along and sets swinging, learned from a recording.
//
//   z' = v - u,   u' = w^2 z + 2 d w z',   F = m u'
//
// u = the part's speed, z = how far the table is ahead of it, m = mass_kg, w = 2 pi frequency_Hz, d = damping_ratio. Solved
// exactly for a table at constant speed over a sub-step, so that momentum is kept: what the part gains the table loses. It
// stands for what no known effect explains and never for a payload: m comes beside the axis's own mass.

#include <array>
#include <cmath>
#include <numbers>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class LearnedMode final : public Effect {
 public:
  LearnedMode(const EffectContext& /*context*/, const EffectSetting& setting)
      : mass_kg_(setting.values[0]),
        w_(2.0 * std::numbers::pi * setting.values[1]),
        falling_per_s_(setting.values[2] * w_),
        turning_per_s_(w_ * std::sqrt(1.0 - setting.values[2] * setting.values[2])) {}

  void reset(double /*position_m*/) noexcept override { ahead_m_ = speed_m_per_s_ = 0.0; }

  [[nodiscard]] EffectLoad load(const EffectMotion& m) const noexcept override {
    const double slip = m.velocity_m_per_s - speed_m_per_s_;
    if (w_ * m.h_s < 1e-7)  // of an instant the difference below is rounding
      return {mass_kg_ * (w_ * w_ * ahead_m_ + 2.0 * falling_per_s_ * slip), 2.0 * mass_kg_ * falling_per_s_};
    const Swing s = swing(m.h_s);
    return {mass_kg_ * (slip - (s.speed_by_place * ahead_m_ + s.speed_by_speed * slip)) / m.h_s,
            mass_kg_ * (1.0 - s.speed_by_speed) / m.h_s};
  }

  void advance(const EffectMotion& m) noexcept override {
    const double slip = m.velocity_m_per_s - speed_m_per_s_;
    const Swing s = swing(m.h_s);
    speed_m_per_s_ = m.velocity_m_per_s - (s.speed_by_place * ahead_m_ + s.speed_by_speed * slip);
    ahead_m_ = s.place_by_place * ahead_m_ + s.place_by_speed * slip;
  }

  [[nodiscard]] double stored_J() const noexcept override {
    return 0.5 * mass_kg_ * (speed_m_per_s_ * speed_m_per_s_ + w_ * w_ * ahead_m_ * ahead_m_);
  }

 private:
  /// z and z' a time h on, by what they were.
  struct Swing {
    double place_by_place, place_by_speed, speed_by_place, speed_by_speed;
  };
  [[nodiscard]] Swing swing(double h_s) const noexcept {
    const double fallen = std::exp(-falling_per_s_ * h_s), turned = turning_per_s_ * h_s;
    const double sine = fallen * std::sin(turned) / turning_per_s_, cosine = fallen * std::cos(turned);
    const double lag = falling_per_s_ * sine;
    return {cosine + lag, sine, -w_ * w_ * sine, cosine - lag};
  }

  double mass_kg_, w_, falling_per_s_, turning_per_s_;  ///< d w; w sqrt(1 - d^2)
  double ahead_m_ = 0.0, speed_m_per_s_ = 0.0;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array learned_mode_parameters{
    EffectParameter{"mass_kg", "kg", 0.0, 1000.0, {}, 0.0, "of the part that swings"},
    EffectParameter{"frequency_Hz", "Hz", 0.1, 100.0, {}, {}, "that it would swing at without its damper"},
    EffectParameter{"damping_ratio", "1", 0.0, 0.9, 0.02, {}, "of its damper"},
};
// clang-format on

inline constexpr EffectEntry learned_mode{
    .id = "learned_mode",
    .component = EffectComponent::load,
    .work = EffectWork::dissipates,
    .meaning = "a part on a light damper that the table sets swinging, learned where no known effect explains the recording",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm force_sensor_N",
    .confused_with = "floor_vibration payload",
    .exciting_move = "short hard moves with a second of rest between",
    .parameters = learned_mode_parameters,
    .make = make_effect<LearnedMode>,
    .hooks = hooks_of<LearnedMode>(),
};

}  // namespace feedtwin::plant::effects

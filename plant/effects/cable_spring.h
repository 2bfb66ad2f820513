#pragma once
// A cable chain or bellows pulls the table towards a place.
//
//   F = k (x - x_0)
//
// k = stiffness_N_per_m, x_0 = neutral_m. The mean over a sub-step is exact, so that it gives back all that it took.

#include <array>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class CableSpring final : public Effect {
 public:
  CableSpring(const EffectContext& /*context*/, const EffectSetting& setting)
      : stiffness_N_per_m_(setting.values[0]), neutral_m_(setting.values[1]) {}

  [[nodiscard]] EffectLoad load(const EffectMotion& m) const noexcept override {
    const double half_s = 0.5 * m.h_s;
    return {stiffness_N_per_m_ * (m.position_m + half_s * m.velocity_m_per_s - neutral_m_), stiffness_N_per_m_ * half_s};
  }

 private:
  double stiffness_N_per_m_, neutral_m_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array cable_spring_parameters{
    EffectParameter{"stiffness_N_per_m", "N/m", 0.0, 100000.0, {}, 0.0, "force for each metre; positive: pulls towards the neutral place"},
    EffectParameter{"neutral_m", "m", -100.0, 100.0, 0.0, {}, "table position without force"},
};
// clang-format on

inline constexpr EffectEntry cable_spring{
    .id = "cable_spring",
    .component = EffectComponent::load,
    .work = EffectWork::conserves,
    .meaning = "a spring-like force of cables or bellows pulls the table towards one place",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm force_sensor_N",
    .confused_with = "position_friction gravity torque_offset",
    .exciting_move = "slow moves over the whole stroke, both directions",
    .parameters = cable_spring_parameters,
    .make = make_effect<CableSpring>,
    .hooks = hooks_of<CableSpring>(),
    .even_in_motion = true,
};

}  // namespace feedtwin::plant::effects

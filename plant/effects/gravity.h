#pragma once
// Weight on an inclined or vertical axis, less its counterbalance.
//
//   F = G,   G = force_N

#include <array>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class Gravity final : public Effect {
 public:
  Gravity(const EffectContext& /*context*/, const EffectSetting& setting) : force_N_(setting.values[0]) {}
  [[nodiscard]] EffectLoad load(const EffectMotion& /*motion*/) const noexcept override { return {force_N_, 0.0}; }

 private:
  double force_N_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array gravity_parameters{
    EffectParameter{"force_N", "N", -100000.0, 100000.0, {}, 0.0, "positive: acts against positive motion"},
};
// clang-format on

inline constexpr EffectEntry gravity{
    .id = "gravity",
    .component = EffectComponent::load,
    .work = EffectWork::conserves,
    .meaning = "a constant force of weight or counterbalance acts on the table",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm force_sensor_N",
    .confused_with = "torque_offset direction_dependent_friction cable_spring",
    .exciting_move = "both directions at the same speeds, with dwells in between",
    .parameters = gravity_parameters,
    .make = make_effect<Gravity>,
    .hooks = hooks_of<Gravity>(),
    .even_in_motion = true,
};

}  // namespace feedtwin::plant::effects

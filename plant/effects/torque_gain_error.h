#pragma once
// The drive's torque constant is not what it believes: all torque is off by a share.
//
//   T_m = (1 + e) T_cmd,   e = relative_error

#include <array>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class TorqueGainError final : public Effect {
 public:
  TorqueGainError(const EffectContext& /*context*/, const EffectSetting& setting) : gain_(1.0 + setting.values[0]) {}
  [[nodiscard]] double torque_Nm(double torque_Nm, const TickStart& /*start*/) const noexcept override {
    return gain_ * torque_Nm;
  }

 private:
  double gain_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array torque_gain_error_parameters{
    EffectParameter{"relative_error", "1", -0.9, 2.0, {}, 0.0, "torque delivered over commanded, less one; positive: more torque"},
};
// clang-format on

inline constexpr EffectEntry torque_gain_error{
    .id = "torque_gain_error",
    .component = EffectComponent::drive,
    .work = EffectWork::none,
    .meaning = "the motor delivers more or less torque than commanded by a constant share",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm force_sensor_N",
    .confused_with = "payload thermal_friction sensor_gain",
    .exciting_move = "any move with a torque or force sensor, or a known added mass",
    .parameters = torque_gain_error_parameters,
    .make = make_effect<TorqueGainError>,
    .hooks = hooks_of<TorqueGainError>(),
};

}  // namespace feedtwin::plant::effects

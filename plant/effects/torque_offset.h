#pragma once
// The drive adds a constant torque: an offset of its analog input or of its current sensors.
//
//   T_m = T_cmd + T_0,   T_0 = offset_Nm

#include <array>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class TorqueOffset final : public Effect {
 public:
  TorqueOffset(const EffectContext& /*context*/, const EffectSetting& setting) : offset_Nm_(setting.values[0]) {}
  [[nodiscard]] double torque_Nm(double torque_Nm, const TickStart& /*start*/) const noexcept override {
    return torque_Nm + offset_Nm_;
  }

 private:
  double offset_Nm_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array torque_offset_parameters{
    EffectParameter{"offset_Nm", "N m", -10.0, 10.0, {}, 0.0, "torque at a zero command; positive: drives forth"},
};
// clang-format on

inline constexpr EffectEntry torque_offset{
    .id = "torque_offset",
    .component = EffectComponent::drive,
    .work = EffectWork::none,
    .meaning = "the drive adds a constant torque",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm",
    .confused_with = "gravity direction_dependent_friction cable_spring",
    .exciting_move = "both directions at the same speeds, with dwells in between",
    .parameters = torque_offset_parameters,
    .make = make_effect<TorqueOffset>,
    .hooks = hooks_of<TorqueOffset>(),
};

}  // namespace feedtwin::plant::effects

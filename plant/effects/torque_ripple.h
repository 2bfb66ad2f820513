#pragma once
// The motor's torque constant varies with the shaft's angle: ripple in proportion to the torque.
//
//   T = T_m (1 + r sin(n theta + phase)),   theta = 2 pi x / p_b
//
// r = relative_amplitude, n = cycles_per_rev, T_m the torque that the drive believes in.

#include <array>

#include "plant/effects/entry.h"
#include "plant/effects/wave.h"

namespace feedtwin::plant::effects {

class TorqueRipple final : public Effect {
 public:
  TorqueRipple(const EffectContext& context, const EffectSetting& setting)
      : per_torque_(-setting.values[0] * context.model.transmission_rad_per_m),
        wave_(context.axis.axis.lead_m, setting.values[1], setting.values[2]) {}

  [[nodiscard]] EffectLoad load(const EffectMotion& m) const noexcept override {
    return wave_.mean_N(m, per_torque_ * m.torque_Nm);
  }

 private:
  double per_torque_;
  RevolutionWave wave_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array torque_ripple_parameters{
    EffectParameter{"relative_amplitude", "1", 0.0, 0.9, {}, 0.0, "half of the ripple from peak to peak, over the torque"},
    EffectParameter{"cycles_per_rev", "1/rev", 0.05, 1000.0, {}, {}, "periods in a revolution"},
    EffectParameter{"phase_rad", "rad", -6.283185307179586, 6.283185307179586, 0.0, {}, "phase at table position 0"},
};
// clang-format on

inline constexpr EffectEntry torque_ripple{
    .id = "torque_ripple",
    .component = EffectComponent::motor,
    .work = EffectWork::motor_torque,
    .meaning = "the motor's torque ripples with the shaft's angle in proportion to the torque",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm",
    .confused_with = "cogging rev_ripple encoder_eccentricity",
    .exciting_move = "steady moves at two loads over several revolutions",
    .parameters = torque_ripple_parameters,
    .make = make_effect<TorqueRipple>,
    .hooks = hooks_of<TorqueRipple>(),
};

}  // namespace feedtwin::plant::effects

#pragma once
// A signal is wired in reverse.
//
//   shown = -true for each sign below zero

#include <array>
#include <cstdint>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class WrongSign final : public Effect {
 public:
  WrongSign(const EffectContext& /*context*/, const EffectSetting& setting) {
    for (std::size_t i = 0; i < sign_.size(); ++i) sign_[i] = setting.values[i] < 0.0 ? -1.0 : 1.0;
  }
  [[nodiscard]] double torque_Nm(double torque_Nm, const TickStart& /*start*/) const noexcept override {
    return sign_[0] * torque_Nm;
  }
  [[nodiscard]] std::int64_t counts(std::int64_t counts) noexcept override { return sign_[1] < 0.0 ? -counts : counts; }
  void show(AxisSignals& signals) noexcept override { signals.scale_position_m *= sign_[2]; }
  void show_forces(ForceSignals& forces) const noexcept override {
    forces.torque_sensor_Nm *= sign_[3];
    forces.force_sensor_N *= sign_[4];
  }

 private:
  std::array<double, 5> sign_{};
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array wrong_sign_parameters{
    EffectParameter{"torque_sign", "1", -1.0, 1.0, 1.0, 1.0, "of the torque command; below 0: reversed"},
    EffectParameter{"encoder_sign", "1", -1.0, 1.0, 1.0, 1.0, "of the motor encoder; below 0: reversed"},
    EffectParameter{"scale_sign", "1", -1.0, 1.0, 1.0, 1.0, "of the linear scale; below 0: reversed"},
    EffectParameter{"torque_sensor_sign", "1", -1.0, 1.0, 1.0, 1.0, "of the torque sensor; below 0: reversed"},
    EffectParameter{"force_sensor_sign", "1", -1.0, 1.0, 1.0, 1.0, "of the force sensor; below 0: reversed"},
};
// clang-format on

inline constexpr EffectEntry wrong_sign{
    .id = "wrong_sign",
    .component = EffectComponent::set_up,
    .work = EffectWork::none,
    .meaning = "a signal is wired in reverse",
    .channels = "torque_cmd_Nm position_m power_W scale_position_m torque_sensor_Nm force_sensor_N",
    .confused_with = "torque_gain_error sensor_gain",
    .exciting_move = "any move",
    .parameters = wrong_sign_parameters,
    .make = make_effect<WrongSign>,
    .hooks = hooks_of<WrongSign>(),
};

}  // namespace feedtwin::plant::effects

#pragma once
// The drive or motor delivers no more than a limit, below the nominal one.
//
//   T_m = clamp(T, -L, L),   L = limit_Nm

#include <algorithm>
#include <array>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class TorqueSaturation final : public Effect {
 public:
  TorqueSaturation(const EffectContext& /*context*/, const EffectSetting& setting) : limit_Nm_(setting.values[0]) {}
  [[nodiscard]] double torque_Nm(double torque_Nm, const TickStart& /*start*/) const noexcept override {
    return std::clamp(torque_Nm, -limit_Nm_, limit_Nm_);
  }

 private:
  double limit_Nm_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array torque_saturation_parameters{
    EffectParameter{"limit_Nm", "N m", 0.001, 10000.0, {}, 10000.0, "largest torque, both directions"},
};
// clang-format on

inline constexpr EffectEntry torque_saturation{
    .id = "torque_saturation",
    .component = EffectComponent::drive,
    .work = EffectWork::none,
    .meaning = "the motor delivers no more torque than a limit below the nominal one",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm",
    .confused_with = "torque_gain_error current_loop_lag",
    .exciting_move = "the strongest acceleration that is commanded",
    .parameters = torque_saturation_parameters,
    .make = make_effect<TorqueSaturation>,
    .hooks = hooks_of<TorqueSaturation>(),
};

}  // namespace feedtwin::plant::effects

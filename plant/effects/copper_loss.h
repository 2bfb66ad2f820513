#pragma once
// Heat in the windings, which the source's Eq. 7 has none of.
//
//   P += c T_m^2
//
// c = coefficient_W_per_Nm2 = R / k_t^2; T_m the motor's torque. Proportional to the torque squared and not to the speed.

#include <array>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class CopperLoss final : public Effect {
 public:
  CopperLoss(const EffectContext& /*context*/, const EffectSetting& setting) : coefficient_(setting.values[0]) {}
  [[nodiscard]] double power_W(const TickPower& power) noexcept override {
    return power.power_W + coefficient_ * power.torque_Nm * power.torque_Nm;
  }

 private:
  double coefficient_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array copper_loss_parameters{
    EffectParameter{"coefficient_W_per_Nm2", "W/(N m)2", 0.0, 100000.0, {}, 0.0, "winding loss over torque squared"},
};
// clang-format on

inline constexpr EffectEntry copper_loss{
    .id = "copper_loss",
    .component = EffectComponent::motor,
    .work = EffectWork::none,
    .meaning = "heat in the windings grows with the square of the torque, at rest too",
    .channels = "power_W",
    .confused_with = "regeneration_clipped power_meter_window torque_gain_error",
    .exciting_move = "holding a load at rest, and strong accelerations at low speed",
    .parameters = copper_loss_parameters,
    .make = make_effect<CopperLoss>,
    .hooks = hooks_of<CopperLoss>(),
};

}  // namespace feedtwin::plant::effects

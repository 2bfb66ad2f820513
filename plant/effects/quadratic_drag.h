#pragma once
// Drag that grows with the square of the speed: air in bellows and covers, churning grease.
//
//   F = c v |v|,   c = coefficient_Ns2_per_m2

#include <array>
#include <cmath>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class QuadraticDrag final : public Effect {
 public:
  QuadraticDrag(const EffectContext& /*context*/, const EffectSetting& setting) : coefficient_(setting.values[0]) {}
  [[nodiscard]] EffectLoad load(const EffectMotion& m) const noexcept override {
    const double per_speed = coefficient_ * std::abs(m.velocity_m_per_s);
    return {per_speed * m.velocity_m_per_s, 2.0 * per_speed};
  }

 private:
  double coefficient_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array quadratic_drag_parameters{
    EffectParameter{"coefficient_Ns2_per_m2", "N s2/m2", 0.0, 1000000.0, {}, 0.0, "force over the square of the speed"},
};
// clang-format on

inline constexpr EffectEntry quadratic_drag{
    .id = "quadratic_drag",
    .component = EffectComponent::load,
    .work = EffectWork::dissipates,
    .meaning = "drag on the table grows with the square of the speed",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm force_sensor_N",
    .confused_with = "sublinear_viscous thermal_friction",
    .exciting_move = "a staircase of steady speeds up to full speed",
    .parameters = quadratic_drag_parameters,
    .make = make_effect<QuadraticDrag>,
    .hooks = hooks_of<QuadraticDrag>(),
    .even_in_motion = true,
};

}  // namespace feedtwin::plant::effects

#pragma once
// Warm-up: the work done against friction heats the grease, and viscous friction falls.
//
//   mu of ball screw and guide times 1 - r (1 - exp(-W / E))
//
// r = viscous_reduction, E = energy_scale_J, W the work done on friction since the run began.

#include <algorithm>
#include <array>
#include <cmath>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class ThermalFriction final : public Effect {
 public:
  ThermalFriction(const EffectContext& /*context*/, const EffectSetting& setting)
      : reduction_(setting.values[0]), energy_J_(setting.values[1]) {}

  void tick(const TickStart& start) noexcept override {
    const double work_J = start.losses.motor_J + start.losses.screw_J + start.losses.guide_J;
    factor_ = 1.0 - reduction_ * (1.0 - std::exp(-std::max(0.0, work_J) / energy_J_));
  }

  void scale(const EffectMotion& /*motion*/, FrictionScale<double>& scale) const noexcept override {
    scale.screw_viscous *= factor_;
    scale.guide_viscous *= factor_;
  }

 private:
  double reduction_, energy_J_;
  double factor_ = 1.0;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array thermal_friction_parameters{
    EffectParameter{"viscous_reduction", "1", -0.5, 0.95, {}, 0.0, "share of the viscous friction that is lost when warm; negative: friction rises"},
    EffectParameter{"energy_scale_J", "J", 0.01, 10000000.0, {}, {}, "friction work after which 63 % of the change is reached"},
};
// clang-format on

inline constexpr EffectEntry thermal_friction{
    .id = "thermal_friction",
    .component = EffectComponent::ball_screw,
    .work = EffectWork::none,
    .meaning = "viscous friction falls as the friction work warms the grease",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm force_sensor_N temperature_C",
    .confused_with = "friction_drift sublinear_viscous torque_gain_error",
    .exciting_move = "the same fast move repeated for minutes from cold",
    .parameters = thermal_friction_parameters,
    .make = make_effect<ThermalFriction>,
    .hooks = hooks_of<ThermalFriction>(),
};

}  // namespace feedtwin::plant::effects

#pragma once
// Warm-up: the work done against friction heats the grease, and viscous friction falls.
//
//   mu of the ball screw times 1 - r - (b - r) exp(-W / E)
//
// r = viscous_reduction, E = energy_scale_J, W the work done on the ball screw's friction since the run began, b =
// initial_reduction: 0 where a run begins cold. thermal_friction_of_all: F_C and F_S of the ball screw too, by r =
// reduction.

#include <array>

#include "plant/effects/entry.h"
#include "plant/effects/law_contact.h"
#include "plant/effects/saturating_change.h"

namespace feedtwin::plant::effects {

class ThermalFriction final : public Effect {
 public:
  ThermalFriction(const EffectContext& context, const EffectSetting& setting)
      : contact_(context.axis), change_(-setting.values[0], setting.values[1], -setting.values[2]) {}

  void tick(const TickStart& start) noexcept override { factor_ = change_.factor(start.law_friction_J); }

  void scale(const EffectMotion& /*motion*/, FrictionScale<double>& scale) const noexcept override {
    contact_.viscous(scale) *= factor_;
  }

 private:
  LawContact contact_;
  SaturatingChange change_;
  double factor_ = 1.0;
};

class ThermalFrictionOfAll final : public Effect {
 public:
  ThermalFrictionOfAll(const EffectContext& context, const EffectSetting& setting)
      : contact_(context.axis), change_(-setting.values[0], setting.values[1], -setting.values[2]) {}

  void tick(const TickStart& start) noexcept override { factor_ = change_.factor(start.law_friction_J); }

  void scale(const EffectMotion& /*motion*/, FrictionScale<double>& scale) const noexcept override {
    contact_.sliding(scale) *= factor_;
    contact_.viscous(scale) *= factor_;
  }

 private:
  LawContact contact_;
  SaturatingChange change_;
  double factor_ = 1.0;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array thermal_friction_parameters{
    EffectParameter{"viscous_reduction", "1", -2.0, 0.95, {}, 0.0, "share of the viscous friction that is lost when warm; negative: friction rises"},
    EffectParameter{"energy_scale_J", "J", 0.01, 10000000.0, {}, {}, "friction work after which 63 % of the change is reached"},
    EffectParameter{"initial_reduction", "1", -2.0, 0.95, 0.0, {}, "share that is lost when a run begins: it begins warm"},
};
inline constexpr std::array thermal_friction_of_all_parameters{
    EffectParameter{"reduction", "1", -2.0, 0.95, {}, 0.0, "share of the friction that is lost when warm; negative: friction rises"},
    EffectParameter{"energy_scale_J", "J", 0.01, 10000000.0, {}, {}, "friction work after which 63 % of the change is reached"},
    EffectParameter{"initial_reduction", "1", -2.0, 0.95, 0.0, {}, "share that is lost when a run begins: it begins warm"},
};
// clang-format on

inline constexpr EffectEntry thermal_friction{
    .id = "thermal_friction",
    .component = EffectComponent::ball_screw,
    .work = EffectWork::none,
    .meaning = "viscous friction of the ball screw falls as its own friction work warms the grease",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm temperature_C",
    .confused_with = "friction_drift sublinear_viscous torque_gain_error",
    .exciting_move = "the same fast move repeated for minutes from cold",
    .parameters = thermal_friction_parameters,
    .make = make_effect<ThermalFriction>,
    .hooks = hooks_of<ThermalFriction>(),
    .of_contact = true,
};

inline constexpr EffectEntry thermal_friction_of_all{
    .id = "thermal_friction_of_all",
    .component = EffectComponent::ball_screw,
    .work = EffectWork::none,
    .meaning = "friction of the ball screw, sliding and viscous, falls with the work done against it",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm temperature_C",
    .confused_with = "friction_drift thermal_friction torque_gain_error",
    .exciting_move = "the same fast move repeated for minutes from cold",
    .parameters = thermal_friction_of_all_parameters,
    .make = make_effect<ThermalFrictionOfAll>,
    .hooks = hooks_of<ThermalFrictionOfAll>(),
    .of_contact = true,
};

}  // namespace feedtwin::plant::effects

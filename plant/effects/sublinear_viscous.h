#pragma once
// Viscous friction of the ball screw that grows slower than the speed: shear-thinning grease.
//
//   F = mu v_r (|v| / v_r)^a sgn v   in place of   mu v,   0 < a <= 1
//
// a = exponent, v_r = reference_speed_m_per_s, at which both are the same. Below 0.1 mm/s the power is continued by a line,
// |v|^(a-1) -> (v^2 + v_0^2)^((a-1)/2), because its slope would be infinite.

#include <array>
#include <cmath>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

class SublinearViscous final : public Effect {
 public:
  SublinearViscous(const EffectContext& context, const EffectSetting& setting)
      : viscous_Ns_per_m_(context.axis.contact_of_laws().viscous_Ns_per_m),
        power_(setting.values[0] - 1.0),
        reference_(std::pow(setting.values[1], -power_)) {}

  [[nodiscard]] EffectLoad load(const EffectMotion& m) const noexcept override {
    if (power_ == 0.0) return {};
    const double v = m.velocity_m_per_s;
    const double mu = m.sign > 0.0 ? viscous_Ns_per_m_.pos : viscous_Ns_per_m_.neg;
    constexpr double v0_m_per_s = 1e-4;
    const double square = v * v + v0_m_per_s * v0_m_per_s;
    const double ratio = reference_ * std::pow(square, 0.5 * power_);
    return {mu * v * (ratio - 1.0), mu * (ratio * (1.0 + power_ * v * v / square) - 1.0)};
  }

 private:
  Directional viscous_Ns_per_m_;
  double power_, reference_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array sublinear_viscous_parameters{
    EffectParameter{"exponent", "1", 0.2, 1.5, {}, 1.0, "power of the speed; 1: the nominal linear friction"},
    EffectParameter{"reference_speed_m_per_s", "m/s", 0.001, 10.0, 0.1, {}, "speed at which the viscous friction is the nominal one"},
};
// clang-format on

inline constexpr EffectEntry sublinear_viscous{
    .id = "sublinear_viscous",
    .component = EffectComponent::ball_screw,
    .work = EffectWork::alters_friction,
    .meaning = "viscous friction of the ball screw grows slower than the speed",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm",
    .confused_with = "thermal_friction frictional_lag",
    .exciting_move = "a staircase of steady speeds from 1 mm/s to full speed",
    .parameters = sublinear_viscous_parameters,
    .make = make_effect<SublinearViscous>,
    .hooks = hooks_of<SublinearViscous>(),
    .even_in_motion = true,
    .of_contact = true,
};

}  // namespace feedtwin::plant::effects

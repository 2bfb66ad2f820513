#pragma once
// Friction of the ball screw that grows with the force through the nut.
//
//   F_C and F_S of the ball screw times 1 + c |F_nut| / F_C,   F_nut = M_L a + F_table + g F_L(v)
//
// c = friction_per_load, F_table all that acts on the table but the guide's own friction: cutting, gravity, springs. The
// guide's friction F_L, as it is while sliding, goes through the nut too: g = guide_friction_share of it, 1 in a machine
// whose axis file says how much of the friction is the guide's; 0 where c is a figure for what comes from outside. Half a
// newton for each newton is the most: near one, friction and what it meets on a soft screw feed each other.

#include <array>
#include <cmath>

#include "plant/effects/entry.h"
#include "plant/steady_friction.h"

namespace feedtwin::plant::effects {

class LoadDependentFriction final : public Effect {
 public:
  LoadDependentFriction(const EffectContext& context, const EffectSetting& setting)
      : coulomb_N_(context.axis.ball_screw.coulomb_N),
        guide_(context.axis.guide),
        table_mass_kg_(context.model.table_mass_kg),
        friction_per_load_(setting.values[0]),
        guide_friction_share_(setting.values[1]) {}

  void scale(const EffectMotion& m, FrictionScale<double>& scale) const noexcept override {
    const double guide_N =
        guide_friction_share_ > 0.0 ? guide_friction_share_ * steady_force_N(guide_, m.velocity_m_per_s) : 0.0;
    const double nut_N = std::abs(table_mass_kg_ * m.acceleration_m_per_s2 + m.table_load_N + guide_N);
    scale.screw_sliding *= 1.0 + friction_per_load_ * nut_N / (m.sign > 0.0 ? coulomb_N_.pos : coulomb_N_.neg);
  }

 private:
  Directional coulomb_N_;
  LugreParameters guide_;
  double table_mass_kg_, friction_per_load_, guide_friction_share_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array load_dependent_friction_parameters{
    EffectParameter{"friction_per_load", "1", 0.0, 0.5, {}, 0.0, "friction force for each newton through the nut"},
    EffectParameter{"guide_friction_share", "1", 0.0, 1.0, 0.0, {}, "how much of the guide's own friction counts as going through the nut"},
};
// clang-format on

inline constexpr EffectEntry load_dependent_friction{
    .id = "load_dependent_friction",
    .component = EffectComponent::ball_screw,
    .work = EffectWork::none,
    .meaning = "friction of the ball screw grows with the force through the nut",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm",
    .confused_with = "payload torque_gain_error torque_ripple",
    .exciting_move = "the same move under two loads, or with strong accelerations",
    .parameters = load_dependent_friction_parameters,
    .make = make_effect<LoadDependentFriction>,
    .hooks = hooks_of<LoadDependentFriction>(),
    .uneven_in_motion = true,
};

}  // namespace feedtwin::plant::effects

#pragma once
// Friction that differs with the direction of motion by more than the nominal numbers say.
//
//   F_C+ += d / 2,  F_C- -= d / 2   (F_S likewise),   mu+ += e / 2,  mu- -= e / 2     on the ball screw
//
// d = coulomb_difference_N, e = viscous_difference_Ns_per_m. A number of the axis, changed at set-up; neither falls below
// a tenth of its nominal value.

#include <algorithm>
#include <array>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

inline void direction_dependent_friction_adapt(AxisParameters& axis, const EffectSetting& setting) {
  const auto shift = [](double& value, double by) { value = std::max(0.1 * value, value + by); };
  auto& screw = axis.ball_screw;
  const double d_N = 0.5 * setting.values[0];
  const double e_Ns_per_m = 0.5 * setting.values[1];
  shift(screw.coulomb_N.pos, d_N);
  shift(screw.static_N.pos, d_N);
  shift(screw.coulomb_N.neg, -d_N);
  shift(screw.static_N.neg, -d_N);
  shift(screw.viscous_Ns_per_m.pos, e_Ns_per_m);
  shift(screw.viscous_Ns_per_m.neg, -e_Ns_per_m);
}

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array direction_dependent_friction_parameters{
    EffectParameter{"coulomb_difference_N", "N", -1000.0, 1000.0, 0.0, 0.0, "F_C+ less F_C-, beyond the nominal difference; positive: more friction forth than back"},
    EffectParameter{"viscous_difference_Ns_per_m", "N s/m", -100000.0, 100000.0, 0.0, 0.0, "mu+ less mu-, beyond the nominal difference; positive: more friction forth than back"},
};
// clang-format on

inline constexpr EffectEntry direction_dependent_friction{
    .id = "direction_dependent_friction",
    .component = EffectComponent::ball_screw,
    .work = EffectWork::none,
    .meaning = "friction in one direction of motion is larger than in the other by more than the nominal numbers say",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm",
    .confused_with = "torque_offset gravity cable_spring",
    .exciting_move = "both directions at several steady speeds, with dwells in between",
    .parameters = direction_dependent_friction_parameters,
    .adapt = direction_dependent_friction_adapt,
};

}  // namespace feedtwin::plant::effects

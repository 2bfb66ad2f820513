#pragma once
// A mass on the table that the nominal numbers do not hold.
//
//   M_L += m,   m = mass_kg
//
// A number of the axis, changed at set-up; the table keeps at least a tenth of its mass.

#include <algorithm>
#include <array>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

inline void payload_adapt(AxisParameters& axis, const EffectSetting& setting) {
  axis.guide_mass_kg = std::max(0.1 * axis.guide_mass_kg, axis.guide_mass_kg + setting.values[0]);
}

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array payload_parameters{
    EffectParameter{"mass_kg", "kg", -1000.0, 100000.0, {}, 0.0, "mass beyond the nominal; negative: less"},
};
// clang-format on

inline constexpr EffectEntry payload{
    .id = "payload",
    .component = EffectComponent::load,
    .work = EffectWork::none,
    .meaning = "the table carries a mass that the nominal numbers do not hold",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm force_sensor_N",
    .confused_with = "torque_gain_error current_loop_lag load_dependent_friction",
    .exciting_move = "strong accelerations at two rates",
    .parameters = payload_parameters,
    .adapt = payload_adapt,
};

}  // namespace feedtwin::plant::effects

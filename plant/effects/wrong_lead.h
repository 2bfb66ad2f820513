#pragma once
// The lead in the configuration is not that of the screw.
//
//   p_b = factor * nominal;   counts are still read as if the nominal were true
//
// A number of the axis, changed at set-up.

#include <array>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

inline void wrong_lead_adapt(AxisParameters& axis, const EffectSetting& setting) {
  axis.axis.lead_m *= setting.values[0];
}

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array wrong_lead_parameters{
    EffectParameter{"factor", "1", 0.1, 10.0, {}, 1.0, "true lead over the nominal"},
};
// clang-format on

inline constexpr EffectEntry wrong_lead{
    .id = "wrong_lead",
    .component = EffectComponent::set_up,
    .work = EffectWork::none,
    .meaning = "the lead in the configuration is not that of the screw",
    .channels = "torque_cmd_Nm position_m power_W scale_position_m torque_sensor_Nm force_sensor_N",
    .confused_with = "lead_error torque_gain_error payload",
    .exciting_move = "one move with a scale at the table",
    .parameters = wrong_lead_parameters,
    .adapt = wrong_lead_adapt,
};

}  // namespace feedtwin::plant::effects

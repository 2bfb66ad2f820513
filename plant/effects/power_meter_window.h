#pragma once
// The power meter averages over another window than the nominal one.
//
//   reading = mean of P over each window_s, shown from the window's end on; every window_s / readings
//
// Numbers of the axis (power.meter_window_s, power.meter_readings), changed at set-up.

#include <array>

#include "plant/effects/entry.h"

namespace feedtwin::plant::effects {

inline void power_meter_window_adapt(AxisParameters& axis, const EffectSetting& setting) {
  axis.power_meter_window_s = setting.values[0];
  axis.power_meter_readings = setting.values[1];
}

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array power_meter_window_parameters{
    EffectParameter{"window_s", "s", 0.001, 10.0, {}, 0.1, "length of a window"},
    EffectParameter{"readings", "1", 0.01, 64.0, 1.0, {}, "readings that a window spans: windows overlap where it is more than one, and do not meet where it is less"},
};
// clang-format on

inline constexpr EffectEntry power_meter_window{
    .id = "power_meter_window",
    .component = EffectComponent::power,
    .work = EffectWork::none,
    .meaning = "the power meter averages over another window than the nominal one",
    .channels = "power_W",
    .confused_with = "regeneration_clipped channel_skew",
    .exciting_move = "fast reversals",
    .parameters = power_meter_window_parameters,
    .adapt = power_meter_window_adapt,
};

}  // namespace feedtwin::plant::effects

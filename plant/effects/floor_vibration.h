#pragma once
// The machine's base shakes; the table feels its inertia.
//
//   F = M_L a_0 sin(2 pi f t + phase)
//
// a_0 = acceleration_m_per_s2, f = frequency_Hz, t since the run began, M_L the table's mass. Rotating parts do not feel it.

#include <array>

#include "plant/effects/entry.h"
#include "plant/effects/wave.h"

namespace feedtwin::plant::effects {

class FloorVibration final : public Effect {
 public:
  FloorVibration(const EffectContext& context, const EffectSetting& setting)
      : inertia_(setting.values[0] * context.model.table_mass_kg, setting.values[1], setting.values[2]) {}
  [[nodiscard]] EffectLoad load(const EffectMotion& m) const noexcept override { return {inertia_.mean_N(m), 0.0}; }

 private:
  TimeWave inertia_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array floor_vibration_parameters{
    EffectParameter{"acceleration_m_per_s2", "m/s2", 0.0, 100.0, {}, 0.0, "amplitude of the base's acceleration along the axis"},
    EffectParameter{"frequency_Hz", "Hz", 0.1, 500.0, {}, {}, "of the shaking"},
    EffectParameter{"phase_rad", "rad", -6.283185307179586, 6.283185307179586, 0.0, {}, "at the start of the run"},
};
// clang-format on

inline constexpr EffectEntry floor_vibration{
    .id = "floor_vibration",
    .component = EffectComponent::load,
    .work = EffectWork::exchanges,
    .meaning = "the base shakes and the table's inertia turns that into a force",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm force_sensor_N",
    .confused_with = "process_force rev_ripple",
    .exciting_move = "standing still and moving slowly for seconds",
    .parameters = floor_vibration_parameters,
    .make = make_effect<FloorVibration>,
    .hooks = hooks_of<FloorVibration>(),
    .even_in_motion = true,
};

}  // namespace feedtwin::plant::effects

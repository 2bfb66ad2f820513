#pragma once
// A force of the process on the table: cutting, with the passing of teeth.
//
//   F = F_0 + A sin(2 pi f t + phase)
//
// F_0 = mean_N, A = amplitude_N, f = frequency_Hz, t since the run began.

#include <array>

#include "plant/effects/entry.h"
#include "plant/effects/wave.h"

namespace feedtwin::plant::effects {

class ProcessForce final : public Effect {
 public:
  ProcessForce(const EffectContext& /*context*/, const EffectSetting& setting)
      : mean_N_(setting.values[0]), teeth_(setting.values[1], setting.values[2], setting.values[3]) {}
  [[nodiscard]] EffectLoad load(const EffectMotion& m) const noexcept override { return {mean_N_ + teeth_.mean_N(m), 0.0}; }

 private:
  double mean_N_;
  TimeWave teeth_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array process_force_parameters{
    EffectParameter{"mean_N", "N", -100000.0, 100000.0, 0.0, 0.0, "mean force; positive: acts against positive motion"},
    EffectParameter{"amplitude_N", "N", 0.0, 1e4, 0.0, 0.0, "half of the alternating force from peak to peak"},
    EffectParameter{"frequency_Hz", "Hz", 0.1, 2000.0, 100.0, {}, "teeth that pass in a second"},
    EffectParameter{"phase_rad", "rad", -6.283185307179586, 6.283185307179586, 0.0, {}, "at the start of the run"},
};
// clang-format on

inline constexpr EffectEntry process_force{
    .id = "process_force",
    .component = EffectComponent::load,
    .work = EffectWork::exchanges,
    .meaning = "a force of the process acts on the table, with the passing of teeth",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm force_sensor_N",
    .confused_with = "gravity floor_vibration",
    .exciting_move = "the same move with and without cutting",
    .parameters = process_force_parameters,
    .make = make_effect<ProcessForce>,
    .hooks = hooks_of<ProcessForce>(),
    .even_in_motion = true,
};

}  // namespace feedtwin::plant::effects
